#include <algorithm>
#include <array>
#include <cmath>

#include "analysis/figure/nice_numbers.hpp"
#include "analysis/figure/triangle_content.hpp"
#include "geometry/base/index.hpp"

namespace isostat {
namespace {

constexpr double kBarLength = 0.75;                        // [diameter of the smaller grain] of an overlap
constexpr double kBeamWhite = 0.5;                         // part of white in the colours of beams
constexpr double kHairline = 0.05, kWidestHairline = 0.6;  // [mean diameter], [pt] as for disks

constexpr double kThinnestBeam = 0.05;  // [pt] most beams of a bed would not be seen

class TriangleForcesContent final : public TriangleContent {
 public:
  explicit TriangleForcesContent(TriangleForceOptions options) : options_(std::move(options)) {}

  // Beams below overlaps; thin before thick, so that the strong chains are on top.
  void draw(Canvas& canvas, const TrianglePen& pen) const override {
    std::vector<std::size_t> style;
    for (const std::int32_t g : pen.grain()) style.push_back(static_cast<std::size_t>(shades(pen.packing())[idx(g)]));
    std::vector<Paint> paints;
    for (const Color& color : {kDisk, kRattler, kUnstressed}) paints.push_back(pen.paint(color));
    pen.grains(canvas, style, paints);
    canvas.begin_group("beams");
    for (const bool stretched : {false, true}) draw_sorted(canvas, pen, beams(pen, stretched), beam_color(stretched));
    canvas.end_group();
    canvas.begin_group("overlaps");
    for (const bool light : {true, false})
      draw_sorted(canvas, pen, overlaps(pen, light), light ? kDistant : kCompressive);
    canvas.end_group();
  }

  std::vector<LegendItem> legend(const TrianglePen& pen, double em) const override {
    std::vector<LegendItem> items;
    if (!overlaps(pen, false).empty()) items.push_back(line_item(em, kCompressive, plain("overlap")));
    if (!overlaps(pen, true).empty())
      items.push_back(line_item(em, kDistant, rich("|`F`| < ") + number_text(*options_.convention.threshold)));
    if (!beams(pen, false).empty()) items.push_back(line_item(em, beam_color(false), plain("beam, compressed")));
    if (!beams(pen, true).empty()) items.push_back(line_item(em, beam_color(true), plain("beam, stretched")));
    const Stroke outline{kDiskOutline, 0.5, {}};
    const std::vector<DiskShade> shade = shades(pen.packing());
    const auto has = [&](DiskShade s) { return std::find(shade.begin(), shade.end(), s) != shade.end(); };
    if (has(DiskShade::rattler)) items.push_back(disk_item(em, {kRattler, outline}, plain("rattler")));
    if (has(DiskShade::unstressed)) items.push_back(disk_item(em, {kUnstressed, outline}, plain("unstressed")));
    if (!(options_.scale > 0)) return items;
    const double force = nice_below(std::min(1.0, em / width_of(options_.scale, pen)) * options_.scale);
    const char* measure = options_.convention.width == ForceMeasure::total ? "|`F`| = " : "|`N`| = ";
    items.push_back(force_scale_item(width_of(force, pen), em, rich(measure) + number_with_unit(force, plain("dyn"))));
    return items;
  }

 private:
  static Color beam_color(bool stretched) { return blend(stretched ? kTensile : kCompressive, kWhite, kBeamWhite); }
  static double total(const Overlap& o) { return std::hypot(o.normal_force, o.tangential_force); }
  bool is_light(const Overlap& o) const {
    return options_.convention.threshold && total(o) < *options_.convention.threshold;
  }
  double width_of(double force, const TrianglePen& pen) const {  // [pt]
    return options_.scale > 0 ? kWidthAtAP * pen.diameter() * force / options_.scale : 0;
  }
  double measure(double normal, double tangential) const {
    return options_.convention.width == ForceMeasure::total ? std::hypot(normal, tangential) : std::abs(normal);
  }

  std::vector<Bar> overlaps(const TrianglePen& pen, bool light) const {
    const TrianglePacking& p = pen.packing();
    const std::vector<double> diameter = grain_diameters(p);
    const double hairline = std::min(kHairline * pen.diameter(), kWidestHairline);
    std::vector<Bar> bars;
    for (const Overlap& o : p.overlaps) {
      if (is_light(o) != light) continue;
      double least = INFINITY;  // of free grains: one of two is
      for (const std::int32_t g : {o.grain_i, o.grain_j})
        if (p.grains.part[idx(g)] == GrainPart::free) least = std::min(least, diameter[idx(g)]);
      if (!std::isfinite(least)) continue;
      const double width = width_of(measure(o.normal_force, o.tangential_force), pen);
      const Vec2 half = kBarLength / 2 * least * o.normal;
      bars.push_back({o.point - half, o.point + half, light ? std::max(width, hairline) : width});
    }
    return bars;
  }

  std::vector<Bar> beams(const TrianglePen& pen, bool stretched) const {
    const TrianglePacking& p = pen.packing();
    std::vector<Bar> bars;
    for (const Link<2>& link : p.links) {
      if (link.normal_force == 0 || (link.normal_force < 0) != stretched) continue;
      const double width = width_of(measure(link.normal_force, link.tangential_force), pen);
      if (width < kThinnestBeam) continue;
      const Vec2& from = p.bodies.position[idx(link.i)];
      const Vec2 shift = p.cell ? p.cell->offset(link.shift) : Vec2{};
      bars.push_back({from, p.bodies.position[idx(link.j)] + shift, width});
    }
    return bars;
  }

  static void draw_sorted(Canvas& canvas, const TrianglePen& pen, std::vector<Bar> bars, const Color& color) {
    std::stable_sort(bars.begin(), bars.end(), [](const Bar& a, const Bar& b) { return a.width < b.width; });
    pen.bars(canvas, bars, color);
  }

  // One a grain.
  std::vector<DiskShade> shades(const TrianglePacking& p) const {
    std::vector<DiskShade> shade(p.grains.size(), DiskShade::plain);
    if (options_.convention.threshold) {
      shade.assign(p.grains.size(), DiskShade::unstressed);
      for (const Overlap& o : p.overlaps)
        if (!is_light(o)) shade[idx(o.grain_i)] = shade[idx(o.grain_j)] = DiskShade::plain;
      return shade;
    }
    for (std::size_t g = 0; g < options_.rattler.size(); ++g)
      if (options_.rattler[g]) shade[g] = DiskShade::rattler;
    return shade;
  }

  TriangleForceOptions options_;
};

}  // namespace

double mean_overlap_force(const TrianglePacking& packing) {
  double sum = 0;
  for (const Overlap& o : packing.overlaps) sum += o.normal_force;
  return packing.overlaps.empty() ? 0 : sum / static_cast<double>(packing.overlaps.size());
}

std::unique_ptr<TriangleContent> triangle_forces_content(TriangleForceOptions options) {
  return std::make_unique<TriangleForcesContent>(std::move(options));
}

}  // namespace isostat
