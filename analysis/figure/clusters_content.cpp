#include <algorithm>
#include <array>

#include "analysis/figure/cluster_colors.hpp"
#include "analysis/figure/picture_content.hpp"
#include "geometry/base/index.hpp"

namespace isostat {
namespace {

class ClustersContent final : public PictureContent {
 public:
  explicit ClustersContent(ClusterOptions options) : options_(std::move(options)) {}

  void draw(Canvas& canvas, const PicturePen& pen) const override {
    const std::vector<std::size_t> color = colors(pen.packing());
    std::vector<Paint> paints;
    for (const Color& fill : cluster_fills()) paints.push_back({fill, pen.outline(kDiskOutline)});
    std::vector<std::size_t> style;
    for (const std::int32_t c : options_.of_grain)
      style.push_back(c < 0 ? 0 : cluster_fill(color[idx(c)], options_.hyperstatic[idx(c)]));
    canvas.begin_group("disks");
    pen.disks(canvas, style, paints);
    canvas.end_group();

    const double width = std::clamp(0.09 * pen.diameter(), 0.25, 3.0);
    std::vector<DrawnLink> between;
    std::array<std::vector<DrawnLink>, kCurves.size()> inside;
    for (std::size_t l = 0; l < pen.packing().links.size(); ++l) {
      const std::int32_t c = options_.of_link[l];
      (c < 0 ? between : inside[color[idx(c)]]).push_back({&pen.packing().links[l], width});
    }
    canvas.begin_group("links");
    pen.links(canvas, between, kFaint);
    for (std::size_t k = 0; k < inside.size(); ++k) pen.links(canvas, inside[k], blend(kCurves[k], kBlack, 0.3));
    canvas.end_group();
  }

  std::vector<LegendItem> legend(const PicturePen& pen, double em) const override {
    std::vector<std::int32_t> of_grain;
    for (std::size_t i = 0; i < options_.of_grain.size(); ++i)
      if (is_free(pen.packing().part, i)) of_grain.push_back(options_.of_grain[i]);
    std::vector<LegendItem> items = cluster_legend(em, of_grain, options_.hyperstatic);
    if (std::find(options_.of_link.begin(), options_.of_link.end(), -1) != options_.of_link.end())
      items.push_back(line_item(em, kFaint, plain("hinge")));
    return items;
  }

 private:
  std::vector<std::size_t> colors(const Packing<2>& packing) const {
    std::vector<std::array<std::int32_t, 2>> meet;
    for (std::size_t l = 0; l < packing.links.size(); ++l) {
      const std::int32_t i = options_.of_grain[idx(packing.links[l].i)], j = options_.of_grain[idx(packing.links[l].j)];
      meet.insert(meet.end(), {{i, j}, {i, options_.of_link[l]}, {j, options_.of_link[l]}});
    }
    return cluster_colors(options_.hyperstatic.size(), meet);
  }

  ClusterOptions options_;
};

}  // namespace

std::unique_ptr<PictureContent> clusters_content(ClusterOptions options) {
  return std::make_unique<ClustersContent>(std::move(options));
}

}  // namespace isostat
