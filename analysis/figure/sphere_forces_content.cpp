#include <algorithm>
#include <array>
#include <tuple>

#include "analysis/figure/force_legend.hpp"
#include "analysis/figure/sphere_content.hpp"

namespace isostat {
namespace {

constexpr double kBehind = 0.45;                           // part of white in spheres behind forces, beside their depth
constexpr double kLinkFog = 0.55;                          // part of white in the farthest line
constexpr double kHairline = 0.04, kWidestHairline = 0.5;  // [mean diameter], [pt]: least width of blue lines

Link<3> as_link(const WallLink& wall) {
  Link<3> link;
  link.kind = wall.kind, link.normal_force = wall.normal_force, link.tangential_force = wall.tangential_force;
  return link;
}

struct DrawnPiece {
  Vec3 from, to;
  LinkColor color;
  double width;  // [pt]
  int level;
};

// Blue below, then green, then red; thin before thick.
auto order_of(const DrawnPiece& p) {
  constexpr std::array<int, 3> kRank{2, 1, 0};  // by LinkColor
  return std::tuple(p.level, kRank[static_cast<std::size_t>(p.color)], p.width);
}

class SphereForcesContent final : public SphereContent {
 public:
  explicit SphereForcesContent(ForceOptions options) : options_(std::move(options)) {}

  void draw(Canvas& canvas, const SpherePen& pen) const override {
    std::vector<std::size_t> style;
    for (const DiskShade s : shades(pen.packing())) style.push_back(static_cast<std::size_t>(s));
    std::vector<Color> colors{blend(kGrain, kWhite, kBehind)};
    for (const Color& grey : {kRattler, kUnstressed}) colors.push_back(grey);
    canvas.begin_group("spheres");
    for (const auto& layer : pen.layers()) pen.balls(canvas, layer, style, colors);
    canvas.end_group();

    const std::vector<DrawnPiece> pieces = sorted_pieces(pen);
    canvas.begin_group("links");
    std::vector<SegmentMark> run;
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      const DrawnPiece& p = pieces[k];
      run.push_back({pen.page(p.from), pen.page(p.to), p.width});
      if (k + 1 < pieces.size() && pieces[k + 1].color == p.color && pieces[k + 1].level == p.level) continue;
      canvas.segments(run, SpherePen::faded(kLinkColors[static_cast<std::size_t>(p.color)], p.level, kLinkFog));
      run.clear();
    }
    canvas.end_group();
  }

  std::vector<LegendItem> legend(const SpherePen& pen, double em) const override {
    ForceMarks marks;
    const auto add = [&](const Link<3>& link) {
      marks.color[static_cast<std::size_t>(link_color(link, options_.convention))] = true;
    };
    for (const Link<3>& link : pen.packing().links) add(link);
    for (const WallLink& wall : pen.packing().wall_links) add(as_link(wall));
    for (const DiskShade s : shades(pen.packing())) marks.shade[static_cast<std::size_t>(s)] = true;
    return force_legend(options_, marks, width_of(options_.scale, pen), em);
  }

 private:
  std::vector<DiskShade> shades(const SpherePacking& packing) const {
    return options_.shade.empty() ? disk_shades(packing, options_.convention, options_.rattler) : options_.shade;
  }
  double width_of(double force, const SpherePen& pen) const {  // [pt]
    const double a = options_.diameter > 0 ? options_.diameter : pen.largest_diameter();
    return options_.width_at_scale * pen.points(a) * force / options_.scale;
  }

  std::vector<DrawnPiece> sorted_pieces(const SpherePen& pen) const {
    const double hairline = std::min(kHairline * pen.diameter(), kWidestHairline);
    std::vector<DrawnPiece> pieces;
    const auto add = [&](const Link<3>& link, const Vec3& from, const Vec3& to) {
      const LinkColor color = link_color(link, options_.convention);
      double width = width_of(drawn_force(link, options_.convention), pen);
      if (color == LinkColor::distant) width = std::max(width, hairline);
      pieces.push_back({from, to, color, width, pen.level(0.5 * (from + to))});
    };
    for (const Link<3>& link : pen.packing().links)
      for (const auto& [from, to] : pen.pieces(link)) add(link, from, to);
    for (const WallLink& wall : pen.packing().wall_links) {
      const auto [from, to] = pen.piece(wall);
      add(as_link(wall), from, to);
    }
    std::stable_sort(pieces.begin(), pieces.end(),
                     [](const DrawnPiece& a, const DrawnPiece& b) { return order_of(a) < order_of(b); });
    return pieces;
  }

  ForceOptions options_;
};

}  // namespace

std::unique_ptr<SphereContent> sphere_forces_content(ForceOptions options) {
  return std::make_unique<SphereForcesContent>(std::move(options));
}

}  // namespace isostat
