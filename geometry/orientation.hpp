// Exact sign of the orientation of three points: the one predicate behind triangle overlaps.
#pragma once
#include "geometry/vec.hpp"

namespace isostat {

// Sign of (a - c) x (b - c): 1 if a, b, c turn anticlockwise, -1 if clockwise, 0 if they lie on one line. Exact for all
// finite doubles: a rounded evaluation with Shewchuk's bound, then an expansion, then (where products under- or
// overflow) rational arithmetic. Source: J. R. Shewchuk, Discrete Comput. Geom. 18, 305 (1997).
int orientation_sign(const Vec2& a, const Vec2& b, const Vec2& c);

}  // namespace isostat
