// Green's theorem along the wall of a region: contributions of circular arcs and of straight links to its area and
// moments. With w = x dy - y dx the area is 1/2 of the integral of w around the region, the first moments 1/3 of that
// of (x, y) w, and the polar second moment 1/4 of that of (x^2 + y^2) w.
#pragma once
#include "geometry/vec.hpp"

namespace isostat {

struct WallIntegrals {
  double w = 0;           // [length^2]
  double xw = 0, yw = 0;  // [length^3]
  double rrw = 0;         // [length^4]
  WallIntegrals& operator+=(const WallIntegrals& o) {
    w += o.w, xw += o.xw, yw += o.yw, rrw += o.rrw;
    return *this;
  }
};

// Arc about `centre` (relative to the origin of the moments) from the unit vector `start`, anticlockwise by `sweep`.
WallIntegrals arc_integrals(const Vec2& centre, double radius, const Vec2& start, double sweep);

// Straight piece from p to q.
WallIntegrals link_integrals(const Vec2& p, const Vec2& q);

}  // namespace isostat
