#include "analysis/rigidity/area_rows.hpp"

#include "dem/triangles/touching_triangles.hpp"
#include "geometry/triangle_overlap.hpp"

namespace isostat {

std::vector<TriangleLoad<double>> area_loads(const LinkNetwork& n, const AreaLink& link, bool tangential) {
  const auto image = [&](std::int32_t body, const ImageShift<2>& shift) {
    return image_of(n.corners[idx(body)], n.packing.cell, shift);
  };
  double twice_area = 0;
  Vec2 force{};
  const auto measure = [&](const AreaPair& pair) {
    const Triangle a = image(pair.i, {}), b = image(pair.j, pair.shift);
    const TriangleOverlap o = triangle_overlap(a, b);
    PairArea<double> area;
    area.twice = {-2 * o.gradient_b.translation[0], -2 * o.gradient_b.translation[1], -2 * o.gradient_a.rotation,
                  -2 * o.gradient_b.rotation};
    area.twice_area = 2 * o.area;
    double parts = 0;
    Vec2 mean{};
    for (const OverlapSide& side : o.sides()) {
      const auto& of = (side.owner == Owner::a ? a : b).corner;
      const Vec2 edge = of[side.edge == 2 ? 0 : side.edge + 1U] - of[side.edge];
      const double part = dot(side.along, edge) / dot(edge, edge);
      parts += part, mean += part * (side.start + 0.5 * side.along);
    }
    for (int k = 0; k < 2; ++k) area.point[idx(k)] = o.origin[k] + mean[k] / parts;
    twice_area += area.twice_area, force += Vec2{{area.twice.fx, area.twice.fy}};
    return area;
  };
  const auto reference = [&](std::int32_t body, const ImageShift<2>& shift) {
    const Triangle t = image(body, shift);
    const Vec2 c = (1.0 / 3) * (t.corner[0] + t.corner[1] + t.corner[2]);
    return PlanePoint<double>{c[0], c[1]};
  };
  auto loads = area_loads<double>(link, tangential, measure, reference);
  const double scale = tangential ? 1 / (twice_area * norm(force)) : 0.5;
  for (auto& l : loads)
    for (double& v : l.at) v *= scale;
  return loads;
}

}  // namespace isostat
