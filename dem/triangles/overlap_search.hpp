// The overlaps of a packing of triangle grains as it stands: pairs of triangles of different grains with common area
// (found as dem/triangles/touching_triangles.hpp finds them), what they add up to, and the loads on the triangles.
#pragma once
#include <vector>

#include "dem/state/balance.hpp"
#include "dem/triangles/triangles.hpp"

namespace isostat {

// Two triangles of different grains with common area; d(area)/d(displacement and angle) of both, as
// geometry/overlap_batch.hpp.
struct TrianglePair {
  std::int32_t grain_i, grain_j;  // i < j
  ImageShift<2> shift;            // of grain j
  std::int32_t a, b;              // triangles of i and of j
  double area = 0;
  Vec2 gradient{};  // of a; of b the opposite
  double rotation_a = 0, rotation_b = 0;
  Vec2 point{};  // inside the overlap, on the side of a
};
// By ascending grains, shifts and triangles; none between grains that are both parts of the container.
std::vector<TrianglePair> overlapping_triangles(const TrianglePacking& packing);

// One record for each pair of grains; the friction springs are those of the packing's overlaps, where it has them.
std::vector<Overlap> overlaps_of(const TrianglePacking& packing, const TriangleLaw& law,
                                 const std::vector<TrianglePair>& pairs);

// Adds the static forces of overlaps, friction springs included, to the loads of the triangles [dyn, dyn cm], and their
// virial to a stress [erg].
void add_overlap_loads(const TrianglePacking& packing, const TriangleLaw& law, const std::vector<TrianglePair>& pairs,
                       std::vector<BodyLoad>& loads, StressTensor& virial);

}  // namespace isostat
