#include <algorithm>
#include <array>
#include <set>

#include "analysis/figure/picture_content.hpp"
#include "geometry/base/index.hpp"

namespace isostat {
namespace {

constexpr double kStrong = 0.35, kPale = 0.75;  // part of white in a hyperstatic and in an isostatic cluster

class ClustersContent final : public PictureContent {
 public:
  explicit ClustersContent(ClusterOptions options) : options_(std::move(options)) {}

  void draw(Canvas& canvas, const PicturePen& pen) const override {
    const std::vector<std::size_t> color = colors(pen.packing());
    // paint 0: in no cluster; then strong and pale of each colour
    std::vector<Paint> paints{{kDisk, pen.outline(kDiskOutline)}};
    for (const Color& c : kCurves)
      for (const double white : {kStrong, kPale})
        paints.push_back({blend(c, kWhite, white), pen.outline(kDiskOutline)});
    std::vector<std::size_t> style;
    for (const std::int32_t c : options_.of_grain)
      style.push_back(c < 0 ? 0 : 1 + 2 * color[idx(c)] + (options_.hyperstatic[idx(c)] ? 0 : 1));
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

  std::vector<LegendItem> legend(const PicturePen&, double em) const override {
    const Stroke outline{kDiskOutline, 0.5, {}};
    const auto with = [&](bool h) {
      return std::find(options_.hyperstatic.begin(), options_.hyperstatic.end(), h) != options_.hyperstatic.end();
    };
    std::vector<LegendItem> items;
    if (with(true))
      items.push_back(disk_item(em, {blend(kCurves[0], kWhite, kStrong), outline}, plain("hyperstatic cluster")));
    if (with(false))
      items.push_back(disk_item(em, {blend(kCurves[0], kWhite, kPale), outline}, plain("isostatic cluster")));
    if (std::find(options_.of_grain.begin(), options_.of_grain.end(), -1) != options_.of_grain.end())
      items.push_back(disk_item(em, {kDisk, outline}, plain("single")));
    if (std::find(options_.of_link.begin(), options_.of_link.end(), -1) != options_.of_link.end())
      items.push_back(line_item(em, kFaint, plain("hinge")));
    return items;
  }

 private:
  // In order of the clusters, the first colour that no neighbour has; the first cluster keeps the first colour.
  std::vector<std::size_t> colors(const Packing<2>& packing) const {
    std::vector<std::set<std::int32_t>> neighbours(options_.hyperstatic.size());
    const auto meet = [&](std::int32_t a, std::int32_t b) {
      if (a >= 0 && b >= 0 && a != b) neighbours[idx(a)].insert(b), neighbours[idx(b)].insert(a);
    };
    for (std::size_t l = 0; l < packing.links.size(); ++l) {
      const std::int32_t i = options_.of_grain[idx(packing.links[l].i)], j = options_.of_grain[idx(packing.links[l].j)];
      meet(i, j), meet(i, options_.of_link[l]), meet(j, options_.of_link[l]);
    }
    std::vector<std::size_t> color(neighbours.size(), kCurves.size());
    for (std::size_t c = 0; c < color.size(); ++c) {
      std::array<bool, kCurves.size()> used{};
      for (const std::int32_t n : neighbours[c])
        if (color[idx(n)] < kCurves.size()) used[color[idx(n)]] = true;
      const auto first = static_cast<std::size_t>(std::find(used.begin(), used.end(), false) - used.begin());
      color[c] = first < used.size() ? first : c % kCurves.size();
    }
    return color;
  }

  ClusterOptions options_;
};

}  // namespace

std::unique_ptr<PictureContent> clusters_content(ClusterOptions options) {
  return std::make_unique<ClustersContent>(std::move(options));
}

}  // namespace isostat
