#include "analysis/figure/wall_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace isostat {
namespace {

constexpr double kStrip = 0.7;     // [mean diameter] beyond the grains in which walls show
constexpr double kMargin = 0.1;    // [mean diameter] around a wall
constexpr double kLidDash = 0.15;  // [mean diameter]
constexpr int kCircleSides = 360;  // of a drum

std::vector<Vec2> points_of(const SmoothWall& wall) {
  if (wall.shape == SmoothWall::Shape::line) return {wall.a, wall.b};
  const double radius = norm(wall.b - wall.a);
  std::vector<Vec2> points;
  for (int k = 0; k <= kCircleSides; ++k) {
    const double angle = 2 * std::numbers::pi * k / kCircleSides;
    points.push_back(wall.a + radius * Vec2{{std::cos(angle), std::sin(angle)}});
  }
  return points;
}

}  // namespace

Extent with_walls(Extent extent, const std::vector<SmoothWall>& walls) {
  if (walls.empty()) return extent;
  const Extent grains = extent;
  for (const SmoothWall& wall : walls)
    for (const Vec2& p : points_of(wall))
      for (int k = 0; k < 2; ++k) {
        // A drum, and a floor however wide, show as a whole; upright walls as far up as the grains.
        const bool upright = wall.shape == SmoothWall::Shape::line && wall.a[0] == wall.b[0];
        const double strip = kStrip * grains.diameter, margin = kMargin * grains.diameter;
        const double at = upright && k == 1 ? std::clamp(p[k], grains.low[k] - strip, grains.high[k] + strip) : p[k];
        extent.low[k] = std::min(extent.low[k], at - margin), extent.high[k] = std::max(extent.high[k], at + margin);
      }
  extent.cut = true;
  return extent;
}

void draw_walls(Canvas& canvas, const FramePen& pen, const std::vector<SmoothWall>& walls) {
  if (walls.empty()) return;
  const double width = std::clamp(0.1 * pen.diameter(), 0.5, 2.0), dash = kLidDash * pen.diameter();
  canvas.begin_group("walls");
  for (const SmoothWall& wall : walls) {
    std::vector<Vec2> line;
    for (const Vec2& p : points_of(wall)) line.push_back(pen.frame().page(p));
    const bool lid = wall.part == GrainPart::lid;
    canvas.polyline(line,
                    lid ? Stroke{kInk, width, {dash, 0.6 * dash}} : Stroke{blend(kWall, kBlack, 0.35), width, {}});
  }
  canvas.end_group();
}

}  // namespace isostat
