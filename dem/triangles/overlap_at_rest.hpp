// Connected overlaps of the grains of a packing with their forces at rest under the law `overlap-energy`:
// U = Y A^2 / (2 L_c), so that the pressure p = Y A / L_c acts on every edge that bounds an overlap.
#pragma once
#include <span>
#include <vector>

#include "dem/triangles/touching_triangles.hpp"
#include "dem/triangles/triangles.hpp"

namespace isostat {

// 1/L_c [1/cm] of two grains: of law.overlap_length if that is given, else the mean of 1/l, l the root of a grain's
// area; a wall or lid has none of its own (L_c = 2 l of the free grain).
double inverse_overlap_length(const TrianglePacking& packing, const TriangleLaw& law, std::int32_t grain_i,
                              std::int32_t grain_j);

// One record for each connected overlap, in the order of `found`.
std::vector<Overlap> overlaps_at_rest(const TrianglePacking& packing, std::span<const Triangle> triangles,
                                      const TriangleLaw& law, const ConnectedOverlaps& found);
inline std::vector<Overlap> overlaps_at_rest(const TrianglePacking& packing, std::span<const Triangle> triangles,
                                             const TriangleLaw& law) {
  return overlaps_at_rest(packing, triangles, law, connected_overlaps(packing, triangles));
}

}  // namespace isostat
