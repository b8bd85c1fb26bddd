#include "analysis/figure/sphere_outlines.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/base/index.hpp"

namespace isostat {
namespace {

constexpr double kBrim = 0.3;     // [mean diameter] of a plane around its grains
constexpr double kFlat = 1e-9;    // a face that is seen edge-on
constexpr double kDotted = 1e-6;  // [pt] an edge that is seen end-on

bool acts_on(const SphereWall& wall, const SpherePacking& packing, std::size_t body) {
  return wall.group == SphereWall::kEveryGroup || wall.group == (packing.group.empty() ? 0 : packing.group[body]);
}

}  // namespace

void draw_cell(Canvas& canvas, const SpherePen& pen, Side side) {
  if (!pen.packing().cell) return;
  const PeriodicCell<3>& cell = *pen.packing().cell;
  const auto looks_away = [&](int axis, int sign) {  // the face that the edge `axis` leads to, or the one opposite
    Vec3 normal{};
    normal[axis] = 1;
    if (axis == 0) normal[1] = -cell.slant();
    return !(sign * pen.view().depth(normal) > kFlat);
  };
  canvas.begin_group("cell");
  for (int along = 0; along < 3; ++along) {
    const int a = (along + 1) % 3, b = (along + 2) % 3;
    for (const int sa : {-1, 1})
      for (const int sb : {-1, 1}) {
        if ((looks_away(a, sa) && looks_away(b, sb)) != (side == Side::back)) continue;
        const Vec3 middle = sa * half_edge(cell, a) + sb * half_edge(cell, b), half = half_edge(cell, along);
        const Vec3 from = middle - half, to = middle + half;
        const std::array ends{pen.page(from), pen.page(to)};
        if (norm(ends[1] - ends[0]) < kDotted) continue;
        canvas.polyline(ends, side == Side::back ? Stroke{kFaint, 0.6, {}} : Stroke{kInk, 0.9, {}});
      }
  }
  canvas.end_group();
}

std::array<Vec3, 4> patch_of(const SpherePacking& packing, const SphereWall& plane) {
  const Vec3& n = plane.normal;
  int least = 0;
  for (int k = 1; k < 3; ++k)
    if (std::abs(n[k]) < std::abs(n[least])) least = k;
  Vec3 u = -n[least] * n;
  u[least] += 1;
  u = u / norm(u);
  const Vec3 v = cross(n, u), middle = middle_of(packing);
  Vec2 low{{INFINITY, INFINITY}}, high{{-INFINITY, -INFINITY}};
  double diameter = 0;
  const Bodies<3>& b = packing.bodies;
  const bool any = [&] {
    for (std::size_t k = 0; k < b.size(); ++k)
      if (acts_on(plane, packing, k)) return true;
    return false;
  }();
  for (std::size_t k = 0; k < b.size(); ++k) {
    diameter += 2 * b.radius[k] / static_cast<double>(b.size());
    if (any && !acts_on(plane, packing, k)) continue;
    const Vec3 d = (packing.cell ? packing.cell->wrap(b.position[k]) : b.position[k]) - plane.point;
    const Vec2 at{{dot(u, d), dot(v, d)}};
    for (int c = 0; c < 2; ++c)
      low[c] = std::min(low[c], at[c] - b.radius[k]), high[c] = std::max(high[c], at[c] + b.radius[k]);
  }
  const double brim = kBrim * diameter;
  const auto corner = [&](double x, double y) { return plane.point - middle + x * u + y * v; };
  return {corner(low[0] - brim, low[1] - brim), corner(high[0] + brim, low[1] - brim),
          corner(high[0] + brim, high[1] + brim), corner(low[0] - brim, high[1] + brim)};
}

void draw_walls(Canvas& canvas, const SpherePen& pen, Side side) {
  if (pen.packing().walls.empty()) return;
  const Stroke edge{blend(kWall, kBlack, 0.35), 0.9, {}};
  canvas.begin_group("walls");
  for (const SphereWall& wall : pen.packing().walls) {
    if (wall.shape != WallShape::plane || (pen.view().depth(wall.normal) >= 0) != (side == Side::back)) continue;
    Polygon outline;
    for (const Vec3& corner : patch_of(pen.packing(), wall)) outline.push_back(pen.page(corner));
    Paint paint{std::nullopt, edge};
    if (side == Side::back) paint.fill = blend(kWall, kWhite, 0.6);
    canvas.polygons({&outline, 1}, paint);
  }
  for (const SphereWall& wall : pen.packing().walls) {  // over planes, which would hide them
    if (wall.shape == WallShape::plane || side != Side::back) continue;
    const DiskMark mark{pen.page(wall.point - middle_of(pen.packing())), pen.points(wall.radius)};
    canvas.disks({&mark, 1}, {std::nullopt, edge});
  }
  canvas.end_group();
}

}  // namespace isostat
