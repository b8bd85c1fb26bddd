#include "analysis/figure/triangle_pen.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "dem/state/container_region.hpp"
#include "geometry/base/index.hpp"
#include "geometry/triangle_mesh.hpp"

namespace isostat {
namespace {

constexpr double kMargin = 0.15;    // [mean diameter] around grains and room
constexpr double kLongWall = 4;     // [mean diameter] a wall grain longer than this is a smooth wall
constexpr double kWallStrip = 0.7;  // [mean diameter] of a smooth wall that shows
constexpr double kLidDash = 0.15;   // [mean diameter]

struct Box {
  Vec2 low{{INFINITY, INFINITY}}, high{{-INFINITY, -INFINITY}};
  void add(const Vec2& p) {
    for (int k = 0; k < 2; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
  }
  void grow(double by) { low -= Vec2{{by, by}}, high += Vec2{{by, by}}; }
  bool meets(const Box& b) const {
    return low[0] < b.high[0] && b.low[0] < high[0] && low[1] < b.high[1] && b.low[1] < high[1];
  }
};

// The edges of two triangles that a beam's seam lies between: those whose corners are nearest to each other, one edge
// being run through against the other.
std::array<std::size_t, 2> seam_between(const Polygon& a, const Polygon& b, const Vec2& offset_of_b) {
  std::array<std::size_t, 2> best{};
  double least = INFINITY;
  for (std::size_t m = 0; m < 3; ++m)
    for (std::size_t n = 0; n < 3; ++n) {
      const double apart = norm(a[m] - b[(n + 1) % 3] - offset_of_b) + norm(a[(m + 1) % 3] - b[n] - offset_of_b);
      if (apart < least) least = apart, best = {m, n};
    }
  return best;
}

}  // namespace

std::vector<double> grain_diameters(const TrianglePacking& packing) {
  std::vector<double> diameter;
  for (std::size_t g = 0; g < packing.grains.size(); ++g) {
    double doubled = 0;
    for (auto k = idx(packing.grains.begin[g]); k < idx(packing.grains.begin[g + 1]); ++k)
      doubled += doubled_area(packing.corner[k][0], packing.corner[k][1], packing.corner[k][2]);
    diameter.push_back(std::sqrt(2 * doubled / std::numbers::pi));
  }
  return diameter;
}

std::optional<Room> room_of(const ContainerScene& container, const Vec2& offset) {
  if (container.shape == ContainerShape::none) return std::nullopt;
  const double half = half_width(container);
  return Room{offset + Vec2{{-half, region_bottom(container)}}, offset + Vec2{{half, region_top(container)}}};
}

Extent extent_of(const TrianglePacking& packing, const std::optional<Room>& room, double margin) {
  const Grains& grains = packing.grains;
  if (grains.size() == 0) throw std::invalid_argument("a picture needs grains");
  Extent extent;
  extent.cell = packing.cell;
  const std::vector<double> diameter = grain_diameters(packing);
  const bool only_walls = std::count(grains.part.begin(), grains.part.end(), GrainPart::free) == 0;
  double count = 0;
  for (std::size_t g = 0; g < grains.size(); ++g)
    if (only_walls || grains.part[g] == GrainPart::free) extent.diameter += diameter[g], ++count;
  extent.diameter /= count;
  if (packing.cell) {
    extent.high = packing.cell->length;
    return extent;
  }

  Box window;
  if (room) window.add(room->low), window.add(room->high);
  std::vector<Box> long_walls;
  for (std::size_t g = 0; g < grains.size(); ++g) {
    Box box;
    for (auto k = idx(grains.begin[g]); k < idx(grains.begin[g + 1]); ++k)
      for (const Vec2& p : corners_of(packing, k)) box.add(p);
    const bool long_wall = !only_walls && grains.part[g] != GrainPart::free &&
                           std::max(box.high[0] - box.low[0], box.high[1] - box.low[1]) > kLongWall * extent.diameter;
    if (long_wall)
      long_walls.push_back(box);
    else
      window.add(box.low), window.add(box.high);
  }
  window.grow(kMargin * extent.diameter + margin);
  Box strip = window;
  strip.grow(kWallStrip * extent.diameter);
  for (const Box& wall : long_walls) {
    if (!wall.meets(strip)) continue;
    for (const Vec2& p : {wall.low, wall.high})
      window.add({{std::clamp(p[0], strip.low[0], strip.high[0]), std::clamp(p[1], strip.low[1], strip.high[1])}});
  }
  extent.low = window.low, extent.high = window.high;
  extent.cut = !long_walls.empty();
  return extent;
}

TrianglePen::TrianglePen(const TrianglePacking& packing, const PictureFrame& frame)
    : FramePen(frame), packing_(packing), grain_(grain_of(packing.grains)), seam_(packing.bodies.size()) {
  for (std::size_t k = 0; k < packing.bodies.size(); ++k) {
    const auto corners = corners_of(packing, k);
    triangle_.emplace_back(corners.begin(), corners.end());
  }
  for (const Link<2>& link : packing.links) {
    const Vec2 offset = packing.cell ? packing.cell->offset(link.shift) : Vec2{};
    const auto [m, n] = seam_between(triangle_[idx(link.i)], triangle_[idx(link.j)], offset);
    seam_[idx(link.i)][m] = seam_[idx(link.j)][n] = true;
  }
}

GrainPart TrianglePen::part(std::size_t triangle) const { return packing_.grains.part[idx(grain_[triangle])]; }

Paint TrianglePen::paint(const Color& fill) const {
  return {fill, Stroke{blend(fill, kGrainOutline, 0.35), std::clamp(0.015 * diameter(), 0.1, 0.5), {}}};
}

void TrianglePen::grains(Canvas& canvas, const std::vector<std::size_t>& style,
                         const std::vector<Paint>& paints) const {
  std::vector<const Polygon*> walls;
  std::vector<std::vector<const Polygon*>> free(paints.size());
  for (std::size_t k = 0; k < triangle_.size(); ++k) {
    if (part(k) == GrainPart::free) free[style[k]].push_back(&triangle_[k]);
    if (part(k) == GrainPart::wall) walls.push_back(&triangle_[k]);
  }
  const double width = std::clamp(0.05 * diameter(), 0.25, 1.2), dash = kLidDash * diameter();
  canvas.begin_group("walls");
  // a stroke of the fill's colour: the hair between two areas that meet would be seen
  areas(canvas, walls, {kWall, Stroke{kWall, 0.3, {}}});
  bars(canvas, outlines(GrainPart::wall, width), blend(kWall, kBlack, 0.35));
  for (const Bar& edge : outlines(GrainPart::lid, width))
    canvas.polyline(std::array{frame().page(edge.from), frame().page(edge.to)},
                    Stroke{kInk, width, {dash, 0.6 * dash}});
  canvas.end_group();
  canvas.begin_group("grains");
  for (std::size_t s = 0; s < paints.size(); ++s) areas(canvas, free[s], paints[s]);
  bars(canvas, outlines(GrainPart::free, width), FramePen::outline(kGrainOutline).color);
  canvas.end_group();
}

std::vector<Bar> TrianglePen::outlines(GrainPart of, double width) const {
  std::vector<Bar> bars;
  for (std::size_t k = 0; k < triangle_.size(); ++k) {
    if (part(k) != of) continue;
    for (std::size_t n = 0; n < 3; ++n)
      if (!seam_[k][n]) bars.push_back({triangle_[k][n], triangle_[k][(n + 1) % 3], width});
  }
  return bars;
}

}  // namespace isostat
