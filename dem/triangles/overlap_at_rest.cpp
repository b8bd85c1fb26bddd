#include "dem/triangles/overlap_at_rest.hpp"

#include "dem/triangles/at_rest.hpp"
#include "geometry/base/index.hpp"
#include "geometry/triangle_overlap.hpp"

namespace isostat {
std::vector<Overlap> overlaps_at_rest(const TrianglePacking& p, std::span<const Triangle> triangles,
                                      const TriangleLaw& law, const ConnectedOverlaps& found) {
  std::vector<Overlap> overlaps;
  overlaps.reserve(found.overlap.size());
  const std::vector<double> inverse = inverse_lengths(p, law);
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
    record.normal_force = overlap_stiffness(law, inverse[idx(o.grain_i)], inverse[idx(o.grain_j)]) * record.area * size;
    if (size > 0) record.normal = (1 / size) * away;
    record.point = (1 / record.area) * moment;
    overlaps.push_back(record);
  }
  return overlaps;
}

}  // namespace isostat
