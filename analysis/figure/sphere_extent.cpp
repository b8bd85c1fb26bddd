// The room that a packing of spheres takes up on the page, and in depth.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "analysis/figure/sphere_outlines.hpp"
#include "analysis/figure/sphere_pen.hpp"

namespace isostat {
namespace {

constexpr double kMargin = 0.1;        // [mean diameter] around everything
constexpr double kSmallestEdge = 440;  // [pt] of the window: what is deep needs more room than what is flat

void grow(Extent& extent, const Vec2& at, double reach) {
  for (int k = 0; k < 2; ++k) {
    extent.low[k] = std::min(extent.low[k], at[k] - reach);
    extent.high[k] = std::max(extent.high[k], at[k] + reach);
  }
}

}  // namespace

Vec3 half_edge(const PeriodicCell<3>& cell, int k) {
  Vec3 half{};
  half[k] = 0.5 * cell.length[k];
  if (k == 1) half[0] = 0.5 * cell.tilt;
  return half;
}

double half_reach(const PeriodicCell<3>& cell, const Vec3& along) {
  double reach = 0;
  for (int k = 0; k < 3; ++k) reach += std::abs(dot(along, half_edge(cell, k)));
  return reach;
}

Vec3 middle_of(const SpherePacking& packing) { return packing.cell ? packing.cell->point({{0.5, 0.5, 0.5}}) : Vec3{}; }

DepthRange depth_range(const SpherePacking& packing, const View& view) {
  DepthRange range;
  if (packing.cell) {
    range.near = half_reach(*packing.cell, view.toward);
    range.far = -range.near;
    return range;
  }
  if (packing.bodies.size() > 0) range.far = range.near = view.depth(packing.bodies.position[0]);
  for (const Vec3& r : packing.bodies.position)
    range.far = std::min(range.far, view.depth(r)), range.near = std::max(range.near, view.depth(r));
  return range;
}

DepthRange around(const DepthRange& a, const DepthRange& b) {
  return {std::min(a.far, b.far), std::max(a.near, b.near)};
}

Extent extent_of(const SpherePacking& packing, const View& view, double margin) {
  const Bodies<3>& b = packing.bodies;
  if (b.size() == 0) throw std::invalid_argument("a picture needs grains");
  const Vec3 middle = middle_of(packing);
  Extent extent;
  extent.smallest_edge = kSmallestEdge;
  for (std::size_t k = 0; k < b.size(); ++k) {
    const Vec2 at = view.flat((packing.cell ? packing.cell->wrap(b.position[k]) : b.position[k]) - middle);
    if (k == 0) extent.low = extent.high = at;
    grow(extent, at, b.radius[k]);
    extent.diameter += 2 * b.radius[k] / static_cast<double>(b.size());
  }
  if (packing.cell) {
    const Vec2 half{{half_reach(*packing.cell, view.right), half_reach(*packing.cell, view.up)}};
    grow(extent, half, 0), grow(extent, -1.0 * half, 0);
    for (int k = 0; k < 2; ++k)  // about the middle, that cells of a series be concentric
      extent.high[k] = std::max(extent.high[k], -extent.low[k]), extent.low[k] = -extent.high[k];
  }
  for (const SphereWall& wall : packing.walls) {
    if (wall.shape == WallShape::shell) grow(extent, view.flat(wall.point - middle), wall.radius);
    if (wall.shape == WallShape::plane)
      for (const Vec3& corner : patch_of(packing, wall)) grow(extent, view.flat(corner), 0);
  }
  margin += kMargin * extent.diameter;
  extent.low -= Vec2{{margin, margin}};
  extent.high += Vec2{{margin, margin}};
  return extent;
}

}  // namespace isostat
