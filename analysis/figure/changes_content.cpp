#include <algorithm>
#include <array>

#include "analysis/figure/cluster_colors.hpp"
#include "analysis/figure/picture_content.hpp"
#include "geometry/base/index.hpp"

namespace isostat {
namespace {

std::vector<DrawnLink> drawn(const std::vector<Link<2>>& links, double width) {
  std::vector<DrawnLink> marks;
  for (const Link<2>& link : links) marks.push_back({&link, width});
  return marks;
}

class ChangesContent final : public PictureContent {
 public:
  explicit ChangesContent(ChangesOptions options)
      : options_(std::move(options)),
        marks_({options_.displacement,
                std::vector<double>(options_.displacement.size()),
                rich("`u`"),
                {},
                options_.length_unit,
                {},
                {plain("less the affine part")}}) {}

  double margin(const Packing<2>& packing) const override { return marks_.margin(extent_of(packing).diameter); }

  void draw(Canvas& canvas, const PicturePen& pen) const override {
    std::vector<std::array<std::int32_t, 2>> meet;
    for (const auto* links : {&options_.kept, &options_.gained, &options_.lost})
      for (const Link<2>& l : *links)
        meet.push_back({options_.region_of_grain[idx(l.i)], options_.region_of_grain[idx(l.j)]});
    const std::vector<std::size_t> color = cluster_colors(options_.regions, meet);
    std::vector<Paint> paints;
    for (const Color& fill : cluster_fills()) paints.push_back({fill, pen.outline(kDiskOutline)});
    std::vector<std::size_t> style;
    for (const std::int32_t r : options_.region_of_grain)
      style.push_back(r < 0 ? 0 : cluster_fill(color[idx(r)], false));
    canvas.begin_group("disks");
    pen.disks(canvas, style, paints);
    canvas.end_group();
    const double width = std::clamp(0.09 * pen.diameter(), 0.25, 3.0);
    canvas.begin_group("links");
    pen.links(canvas, drawn(options_.kept, width), kFaint);
    pen.links(canvas, drawn(options_.gained, 2.5 * width), kTensile);
    pen.links(canvas, drawn(options_.lost, 2.5 * width), kCompressive);
    canvas.end_group();
    marks_.draw_arrows(canvas, pen, pen.packing().bodies.position);
  }

  std::vector<LegendItem> legend(const PicturePen& pen, double em) const override {
    std::vector<LegendItem> items;
    const Stroke outline{kDiskOutline, 0.5, {}};
    if (options_.regions > 0)
      items.push_back(disk_item(em, {cluster_fills()[cluster_fill(0, false)], outline}, plain("moved rigidly")));
    if (!options_.kept.empty()) items.push_back(line_item(em, kFaint, plain("contact kept")));
    if (!options_.gained.empty()) items.push_back(line_item(em, kTensile, plain("gained")));
    if (!options_.lost.empty()) items.push_back(line_item(em, kCompressive, plain("lost")));
    const std::vector<LegendItem> motion = marks_.legend(pen, em);
    items.insert(items.end(), motion.begin(), motion.end());
    return items;
  }

 private:
  ChangesOptions options_;
  MotionMarks marks_;
};

}  // namespace

std::unique_ptr<PictureContent> changes_content(ChangesOptions options) {
  return std::make_unique<ChangesContent>(std::move(options));
}

}  // namespace isostat
