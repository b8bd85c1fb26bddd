// Exact signs of the polynomials that decide the dual complex of disks: a rounded evaluation with a proven error
// bound, and rational arithmetic when it cannot tell.
#pragma once
#include <cstdint>

#include "geometry/periodic_cell.hpp"
#include "geometry/vec.hpp"

namespace isostat {

// Sign of |q + n L - p|^2 - (r_p + r_q + tolerance)^2; n = (nx, ny) whole cells, n L = (nx L1 + ny tilt, ny L2). With
// -r_q it tells whether one disk lies inside the other.
int gap_sign(const Vec2& p, const Vec2& q, std::int64_t nx, std::int64_t ny, const PeriodicCell<2>& cell,
             double radius_p, double radius_q, double tolerance);

// Three sites at 0, a, b (exact differences, anticlockwise) of weights w0, wa, wb: sign of the power of the
// orthocentre, (q_a b_y - q_b a_y)^2 + (a_x q_b - b_x q_a)^2 - 4 (a x b)^2 w0 with q_a = |a|^2 - w_a + w0.
int orthoradius_sign(const Vec2& a, const Vec2& b, double w0, double wa, double wb);

// Two sites at 0 and d, a third at t: sign of the power of the third at the centre m of the smallest circle orthogonal
// to the two, less their own power there: |d|^2 (|t|^2 - w_t + w0) - (t.d)(|d|^2 + w0 - w_d). Positive: m lies on the
// inner side of the third site's cell.
int edge_centre_sign(const Vec2& d, const Vec2& t, double w0, double wd, double wt);

}  // namespace isostat
