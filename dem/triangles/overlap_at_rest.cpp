#include "dem/triangles/overlap_at_rest.hpp"

#include <cmath>

#include "geometry/base/index.hpp"
#include "geometry/triangle_overlap.hpp"

namespace isostat {
namespace {

double inverse_length(const TrianglePacking& p, std::int32_t grain) {
  if (p.grains.part[idx(grain)] != GrainPart::free) return 0;
  double area = 0;
  for (auto k = idx(p.grains.begin[idx(grain)]); k < idx(p.grains.begin[idx(grain) + 1]); ++k) {
    const Vec2 u = p.corner[k][1] - p.corner[k][0], v = p.corner[k][2] - p.corner[k][0];
    area += (u[0] * v[1] - u[1] * v[0]) / 2;
  }
  return 1 / std::sqrt(area);
}

}  // namespace

double inverse_overlap_length(const TrianglePacking& p, const TriangleLaw& law, std::int32_t grain_i,
                              std::int32_t grain_j) {
  if (law.overlap_length > 0) return 1 / law.overlap_length;
  return (inverse_length(p, grain_i) + inverse_length(p, grain_j)) / 2;
}

std::vector<Overlap> overlaps_at_rest(const TrianglePacking& p, std::span<const Triangle> triangles,
                                      const TriangleLaw& law, const ConnectedOverlaps& found) {
  std::vector<Overlap> overlaps;
  overlaps.reserve(found.overlap.size());
  for (const ConnectedOverlap& o : found.overlap) {
    Overlap record{.grain_i = o.grain_i, .grain_j = o.grain_j, .shift = o.shift};
    Vec2 away{}, moment{};  // minus the gradient for grain j; first moment of the area
    for (const TriangleTouch& t : found.of(o)) {
      const TriangleOverlap pair =
          triangle_overlap(triangles[idx(t.i)], image_of(triangles[idx(t.j)], p.cell, t.shift));
      Vec2 middle{};
      for (const OverlapSide& s : pair.sides()) middle += (1.0 / pair.side_count) * s.start;
      record.area += pair.area;
      away -= pair.gradient_b.translation;
      moment += pair.area * (pair.origin + middle);
    }
    const double size = norm(away);
    record.normal_force = law.modulus * record.area * inverse_overlap_length(p, law, o.grain_i, o.grain_j) * size;
    if (size > 0) record.normal = (1 / size) * away;
    record.point = (1 / record.area) * moment;
    overlaps.push_back(record);
  }
  return overlaps;
}

}  // namespace isostat
