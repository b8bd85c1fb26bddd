#include <algorithm>
#include <array>

#include "analysis/figure/force_legend.hpp"
#include "analysis/figure/picture_content.hpp"

namespace isostat {
namespace {

constexpr double kHairline = 0.05;       // [mean diameter] least width of blue lines, which tell a kind and not a force
constexpr double kWidestHairline = 0.6;  // [pt]

class ForcesContent final : public PictureContent {
 public:
  explicit ForcesContent(ForceOptions options) : options_(std::move(options)) {}

  // Blue below, then thin before thick, so that the strong chains are on top.
  void draw(Canvas& canvas, const PicturePen& pen) const override {
    canvas.begin_group("disks");
    std::vector<std::size_t> style;
    for (const DiskShade shade : shades(pen)) style.push_back(static_cast<std::size_t>(shade));
    std::vector<Paint> paints;
    for (const Color& color : kShades) paints.push_back({color, pen.outline(kDiskOutline)});
    pen.disks(canvas, style, paints);
    canvas.end_group();

    canvas.begin_group("links");
    const double hairline = std::min(kHairline * pen.diameter(), kWidestHairline);
    std::array<std::vector<DrawnLink>, 3> by_color;
    for (const Link<2>& link : pen.packing().links) {
      const LinkColor color = link_color(link, options_.convention);
      double width = width_of(drawn_force(link, options_.convention), pen);
      if (color == LinkColor::distant) width = std::max(width, hairline);
      by_color[static_cast<std::size_t>(color)].push_back({&link, width});
    }
    for (auto& links : by_color)
      std::stable_sort(links.begin(), links.end(), [](const auto& a, const auto& b) { return a.width < b.width; });
    for (const LinkColor color : {LinkColor::distant, LinkColor::tensile, LinkColor::compressive})
      pen.links(canvas, by_color[static_cast<std::size_t>(color)], kLinkColors[static_cast<std::size_t>(color)]);
    canvas.end_group();
  }

  std::vector<LegendItem> legend(const PicturePen& pen, double em) const override {
    ForceMarks marks;
    for (const Link<2>& link : pen.packing().links)
      marks.color[static_cast<std::size_t>(link_color(link, options_.convention))] = true;
    for (const DiskShade s : shades(pen)) marks.shade[static_cast<std::size_t>(s)] = true;
    return force_legend(options_, marks, width_of(options_.scale, pen), em);
  }

 private:
  std::vector<DiskShade> shades(const PicturePen& pen) const {
    return options_.shade.empty() ? disk_shades(pen.packing(), options_.convention, options_.rattler) : options_.shade;
  }
  double width_of(double force, const PicturePen& pen) const {  // [pt]
    const double a = options_.diameter > 0 ? options_.diameter : pen.largest_diameter();
    return options_.width_at_scale * a * pen.frame().scale() * force / options_.scale;
  }

  ForceOptions options_;
};

}  // namespace

std::unique_ptr<PictureContent> forces_content(ForceOptions options) {
  return std::make_unique<ForcesContent>(std::move(options));
}

}  // namespace isostat
