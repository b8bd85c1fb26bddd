#include <algorithm>
#include <array>

#include "analysis/figure/nice_numbers.hpp"
#include "analysis/figure/picture_content.hpp"

namespace isostat {
namespace {

constexpr double kHairline = 0.05;       // [mean diameter] least width of blue lines, which tell a kind and not a force
constexpr double kWidestHairline = 0.6;  // [pt]

constexpr std::array<Color, 3> kLinkColors = {kCompressive, kTensile, kDistant};  // by LinkColor
constexpr std::array<Color, 3> kShades = {kDisk, kRattler, kUnstressed};          // by DiskShade

class ForcesContent final : public PictureContent {
 public:
  explicit ForcesContent(ForceOptions options) : options_(std::move(options)) {}

  // Blue below, then thin before thick, so that the strong chains are on top.
  void draw(Canvas& canvas, const PicturePen& pen) const override {
    canvas.begin_group("disks");
    std::vector<std::size_t> style;
    for (const DiskShade shade : disk_shades(pen.packing(), options_.convention, options_.rattler))
      style.push_back(static_cast<std::size_t>(shade));
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
    std::array<bool, 3> color{}, shade{};
    for (const Link<2>& link : pen.packing().links)
      color[static_cast<std::size_t>(link_color(link, options_.convention))] = true;
    for (const DiskShade s : disk_shades(pen.packing(), options_.convention, options_.rattler))
      shade[static_cast<std::size_t>(s)] = true;
    const auto& threshold = options_.convention.threshold;
    std::vector<LegendItem> items;
    if (color[0]) items.push_back(line_item(em, kCompressive, plain("compressive")));
    if (color[1]) items.push_back(line_item(em, kTensile, plain("tensile")));
    if (color[2]) items.push_back(line_item(em, kDistant, threshold ? below(*threshold) : plain("distant")));
    const Stroke outline{kDiskOutline, 0.5, {}};
    if (shade[1]) items.push_back(disk_item(em, {kRattler, outline}, plain("rattler")));
    if (shade[2]) items.push_back(disk_item(em, {kUnstressed, outline}, plain("unstressed")));
    items.push_back(scale_bar(pen, em));
    return items;
  }

 private:
  double width_of(double force, const PicturePen& pen) const {  // [pt]
    return options_.width_at_scale * pen.largest_diameter() * pen.frame().scale() * force / options_.scale;
  }

  // The threshold is in the force unit of the packing: F1 by name only where F1 is that unit.
  RichText below(double threshold) const {
    return rich("|`F`| < ") + number_with_unit(threshold, options_.scale == 1 ? options_.scale_label : RichText{});
  }

  // A bar not thicker than the text is high, for a round part of F1 (or a round number where F1 has no name).
  LegendItem scale_bar(const PicturePen& pen, double em) const {
    const double most = std::min(1.0, em / width_of(options_.scale, pen));
    const bool named = !options_.scale_label.empty();
    const double fraction = most < 1 ? nice_below(most) : 1;
    const double force = named ? fraction * options_.scale : nice_below(most * options_.scale);
    const RichText value = !named          ? number_text(force)
                           : fraction == 1 ? options_.scale_label
                                           : number_with_unit(fraction, options_.scale_label);
    const char* measure = options_.convention.width == ForceMeasure::total ? "|`F`| = " : "|`N`| = ";
    return force_scale_item(width_of(force, pen), em, rich(measure) + value);
  }

  ForceOptions options_;
};

}  // namespace

std::unique_ptr<PictureContent> forces_content(ForceOptions options) {
  return std::make_unique<ForcesContent>(std::move(options));
}

}  // namespace isostat
