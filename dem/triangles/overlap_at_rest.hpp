// Connected overlaps of the grains of a packing with their forces at rest under the law `overlap-energy`:
// U = Y A^2 / (2 L_c), so that the pressure p = Y A / L_c acts on every edge that bounds an overlap.
#pragma once
#include <span>
#include <vector>

#include "dem/triangles/touching_triangles.hpp"
#include "dem/triangles/triangles.hpp"

namespace isostat {

// One record for each connected overlap, in the order of `found`.
std::vector<Overlap> overlaps_at_rest(const TrianglePacking& packing, std::span<const Triangle> triangles,
                                      const TriangleLaw& law, const ConnectedOverlaps& found);
inline std::vector<Overlap> overlaps_at_rest(const TrianglePacking& packing, std::span<const Triangle> triangles,
                                             const TriangleLaw& law) {
  return overlaps_at_rest(packing, triangles, law, connected_overlaps(packing, triangles));
}

}  // namespace isostat
