// The overlap of two triangles: type, area, boundary and gradient, for one pair, exact in what is decided and faithful
// in what is measured. overlap_batch.hpp is the fast path of dynamics; this one serves `lab overlap`, the rigidity
// matrix and the tests.
//
// Signs are exact (triangle_signs.hpp), and they alone say which edges bound the overlap. Its corners are then computed
// with twice the precision of double, or with rationals where the bound in triangle_overlap.cpp asks for it:
//   area       relative error below 2^-52, whatever the pair (a subnormal area is one of the two doubles beside it);
//              exactly 0 for separate and touch
//   sides      each component rounded once from a value whose own error is below 2^-54 of the extent of the pair
//   gradient   a few roundings of sums over the sides
#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "geometry/overlap_boundary.hpp"

namespace isostat {

// One side of the overlap, with the overlap on its left.
struct OverlapSide {
  Owner owner = Owner::a;                        // the triangle whose boundary it lies on; A's where both have it
  std::uint8_t edge = 0;                         // of the owner, as numbered by the caller
  CornerKind start_kind = CornerKind::corner_a;  // where it starts: a corner of A or of B, or a crossing
  std::uint8_t start_a = 0;                      // corner of A; of a crossing: edge of A
  std::uint8_t start_b = 0;                      // corner of B; of a crossing: edge of B
  Vec2 start;                                    // relative to TriangleOverlap::origin
  Vec2 along;                                    // to the start of the next side
};

// Straight line between two crossings S1, S2: the paper's contact line (Figs. 3-5).
struct OverlapChord {
  Vec2 start;  // S1, relative to the origin
  Vec2 along;  // S2 - S1
  double length = 0;
};

// d(area)/d(displacement) and d(area)/d(angle about the centroid) of one triangle, the other at rest. With n the
// outward normal: sum over the triangle's own sides of |along| n, and of (midpoint - centroid) x |along| n. The
// overlap's force is minus the pressure times this. Where edges coincide it is that of the sides as listed: one-sided.
struct OverlapGradient {
  Vec2 translation;     // [length]
  double rotation = 0;  // [length^2], per radian, anticlockwise
};

struct TriangleOverlap {
  OverlapType type = OverlapType::separate;
  double area = 0;
  Vec2 origin;  // corner 0 of A: what positions are relative to
  std::array<OverlapSide, 6> side_store;
  int side_count = 0;
  std::array<OverlapChord, 2> chord_store;
  int chord_count = 0;
  OverlapGradient gradient_a, gradient_b;  // gradient_b.translation = -gradient_a.translation

  // In order around the overlap, anticlockwise; none for separate and touch. Where edges cross, the first side starts
  // where the lowest edge of A (as numbered by the caller if A is anticlockwise) enters B: S1.
  std::span<const OverlapSide> sides() const { return {side_store.data(), static_cast<std::size_t>(side_count)}; }
  // Types i and ii: S1S2. Type iii, the quadrilateral S1S2S3S4: S1S2 on an edge of A and S1S4 on an edge of B.
  std::span<const OverlapChord> chords() const { return {chord_store.data(), static_cast<std::size_t>(chord_count)}; }
};

// For all finite coordinates and either orientation. Source of the area: Green's theorem on the boundary.
TriangleOverlap triangle_overlap(const Triangle& a, const Triangle& b);

}  // namespace isostat
