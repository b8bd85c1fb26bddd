// Geometry of one link, shared by the force kernels and the rigidity matrix: frame, lever arms, and the row of G that
// takes body velocities to link velocities (Gilabert 2007, Eqs. A1-A3). Real is double or a SIMD vector of doubles.
//
// Link velocities (the power of a link force is force * velocity, so body forces = G^T (N, T, M)):
//   normal     n . (v_j - v_i)                                 conjugate to N
//   tangential t . (v_j - v_i) - l_i w_i - l_j w_j             conjugate to T
//   rolling    w_j - w_i                                       conjugate to M
// v includes the affine motion of the cell; with the strain rate e_a = -Ldot_a / L_a (compression positive) the affine
// part of v_j - v_i is -e_a r_ij,a.
#pragma once
#include <cmath>

#include "geometry/base/mul_add.hpp"

namespace isostat {

// The part of the frame that needs only the branch vector and R_i + R_j. The lever arms are proportional,
// l_i = lever_ratio R_i with lever_ratio = |r_ij| / (R_i + R_j), not R_i: with the radii a rigid rotation of
// overlapping disks would not be a null vector of G.
template <class Real>
struct PairFrame {
  Real nx, ny;       // unit normal from i to j; the tangent is t = z x n = (-ny, nx)
  Real distance;     // [a] |r_ij|
  Real gap;          // [a] h = |r_ij| - R_i - R_j
  Real lever_ratio;  // [-]
};

template <class Real>
struct LinkFrame : PairFrame<Real> {
  Real lever_i, lever_j;  // [a] contact point to centre
};

template <class Real>
struct LinkVelocity {
  Real normal, tangential, rolling;
};

// The adjoint of LinkVelocity: force on j (opposite on i) and the two moments from (N, T, M).
template <class Real>
struct LinkLoad {
  Real fx, fy;              // force on j
  Real moment_i, moment_j;  // about the centres
};

// (dx, dy) = r_ij including the image shift; one division serves 1/distance and 1/radius_sum.
template <class Real>
inline PairFrame<Real> pair_frame(Real dx, Real dy, Real radius_sum) {
  using std::sqrt;
  const Real distance = sqrt(mul_add<Real>(dx, dx, dy * dy));
  const Real q = Real(1.0) / (distance * radius_sum);
  const Real inverse = q * radius_sum;
  return {dx * inverse, dy * inverse, distance, distance - radius_sum, q * distance * distance};
}

template <class Real>
inline LinkFrame<Real> link_frame(Real dx, Real dy, Real radius_i, Real radius_j) {
  const PairFrame<Real> f = pair_frame<Real>(dx, dy, radius_i + radius_j);
  return {f, f.lever_ratio * radius_i, f.lever_ratio * radius_j};
}

// surface_sum = R_i w_i + R_j w_j, spin_difference = w_j - w_i.
template <class Real>
inline LinkVelocity<Real> pair_velocity(const PairFrame<Real>& f, Real dvx, Real dvy, Real surface_sum,
                                        Real spin_difference) {
  const Real turn = mul_add<Real>(-f.ny, dvx, f.nx * dvy);
  return {mul_add<Real>(f.nx, dvx, f.ny * dvy), mul_add<Real>(-f.lever_ratio, surface_sum, turn), spin_difference};
}

template <class Real>
inline LinkVelocity<Real> link_velocity(const LinkFrame<Real>& f, Real dvx, Real dvy, Real spin_i, Real spin_j) {
  return {f.nx * dvx + f.ny * dvy, f.nx * dvy - f.ny * dvx - (f.lever_i * spin_i + f.lever_j * spin_j),
          spin_j - spin_i};
}

template <class Real>
inline LinkLoad<Real> link_load(const LinkFrame<Real>& f, Real normal, Real tangential, Real moment) {
  return {normal * f.nx - tangential * f.ny, normal * f.ny + tangential * f.nx, -(tangential * f.lever_i) - moment,
          moment - tangential * f.lever_j};
}

// Loads of unit link forces times a positive factor that leaves no root: rational in r_ij = (x, y) and the radii, so
// that an exact field can take them. A row of G is such a load (G^T takes link forces to body forces), scaled or not;
// exact rank and the rows of doubles stand on link_load() and these, and a test holds the two together.
template <class Real>
inline LinkLoad<Real> rational_normal(Real x, Real y) {  // times |r|
  return {x, y, Real{}, Real{}};
}
template <class Real>
inline LinkLoad<Real> rational_tangential(Real x, Real y, Real radius_i, Real radius_j) {  // times |r| (R_i + R_j)
  const Real sum = radius_i + radius_j, square = x * x + y * y;
  return {-(y * sum), x * sum, -(square * radius_i), -(square * radius_j)};
}
template <class Real>
inline LinkLoad<Real> rational_rolling() {  // as it is
  return {Real{}, Real{}, -Real(1), Real(1)};
}

}  // namespace isostat
