// Overlaps of many pairs of triangles at once, for dynamics: one branch-free clip (overlap_clip.hpp), one pair a lane,
// compiled for each instruction set. Types are not told apart: area and gradient are continuous across them.
#pragma once
#include <array>
#include <cstddef>

#include "geometry/base/isa.hpp"

namespace isostat {

// Corner k of pair n is at (x[k][n], y[k][n]); anticlockwise, of positive area, of an extent M of the pair (the largest
// coordinate difference) within 1e-60 and 1e60 in whatever unit.
struct TriangleArrays {
  std::array<const double*, 3> x{}, y{};
};

// One number a pair; none may be null.
struct OverlapArrays {
  double* area = nullptr;        // [length^2]
  double* gradient_x = nullptr;  // d(area)/d(displacement of A); of B the opposite [length]
  double* gradient_y = nullptr;
  double* rotation_a = nullptr;  // d(area)/d(angle of A about its centroid) [length^2 per rad]
  double* rotation_b = nullptr;  // of B
  double* chord = nullptr;       // |gradient|: for types i and ii the length of S1S2 [length]
};

// out[0..n) of pairs a[0..n), b[0..n). Against triangle_overlap(), with u = 2^-53: area within 64 u M^2 for all pairs
// (within 64 u M times the perimeter, if that is more than a few u M); gradient within 64 u M over the sine of the
// angles at its corners, and rotations M times that. Where an edge of A lies on one of B within rounding the gradient
// is one-sided, and that of a pair that only touches along an edge may be that of contact or none (its area is 0 within
// the bound either way). Instruction sets differ by rounding; a pair's result does not depend on its place or on n.
using OverlapBatch = void (*)(std::size_t n, const TriangleArrays& a, const TriangleArrays& b,
                              const OverlapArrays& out);

OverlapBatch overlap_batch(Isa isa = machine_isa());  // chosen once a run

}  // namespace isostat
