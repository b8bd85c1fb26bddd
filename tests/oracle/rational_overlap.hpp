// The overlap of two triangles in rational arithmetic (GMP), by the definitions and without cleverness: A cut by the
// three half-planes of B, edges crossed with edges. The oracle of geometry/triangle_overlap.hpp.
#pragma once
#include <gmpxx.h>

#include <array>
#include <vector>

#include "geometry/triangle_signs.hpp"

namespace isostat::oracle {

struct RationalPoint {
  mpq_class x, y;
};
struct RationalOverlap {
  OverlapType type = OverlapType::separate;
  mpq_class area;
  std::vector<RationalPoint> polygon;  // corners in order, some of them twice where the pair is degenerate
};

// At most one of the triangles may be without area.
RationalOverlap rational_overlap(const Triangle& a, const Triangle& b);

int rational_orientation(const Vec2& a, const Vec2& b, const Vec2& c);

}  // namespace isostat::oracle
