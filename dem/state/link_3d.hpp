// Geometry of one link in space, the twin of dem/state/link.hpp: frame, lever arms, link velocities and their adjoint,
// shared by the force kernels and the rigidity matrix. Real is double or a SIMD vector of doubles, and for the loads
// without roots also an element of an exact field.
//
// The contact point lies l_i n from i and -l_j n from j. Link velocities (the power of a link force is force *
// velocity, so body forces = G^T (N, T, M)):
//   contact    v_c = v_j - v_i - (l_i w_i + l_j w_j) x n       conjugate to the contact force N n + T
//   normal     n . v_c = n . (v_j - v_i)                       conjugate to N
//   tangential v_c - n (n . v_c)                               conjugate to T, a vector normal to n
//   rolling    w_j - w_i, rolling and twisting                 conjugate to M, a vector
// Forces and moments are those on j; i bears -(N n + T), -l_i n x T - M, and j the moment -l_j n x T + M. Exchanging i
// and j turns n, v_c, T and M round. With w along z these are the formulas of the plane, T there counted along z x n.
#pragma once
#include <array>
#include <cmath>

#include "geometry/base/mul_add.hpp"

namespace isostat {

template <class Real>
using Real3 = std::array<Real, 3>;

template <class Real>
inline Real dot_3d(const Real3<Real>& a, const Real3<Real>& b) {
  return mul_add<Real>(a[0], b[0], mul_add<Real>(a[1], b[1], a[2] * b[2]));
}
template <class Real>
inline Real3<Real> cross_3d(const Real3<Real>& a, const Real3<Real>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// The part of the frame that needs only the branch vector and R_i + R_j. Lever arms are proportional, l_i = lever_ratio
// R_i, for the reason given in link.hpp; so l_i n = r R_i / (R_i + R_j) has no root.
template <class Real>
struct PairFrame3 {
  Real3<Real> n;     // unit normal from i to j
  Real distance;     // [a] |r_ij|
  Real gap;          // [a] h = |r_ij| - R_i - R_j
  Real lever_ratio;  // [-] |r_ij| / (R_i + R_j)
};

template <class Real>
struct LinkFrame3 : PairFrame3<Real> {
  Real lever_i, lever_j;  // [a] contact point to centre
};

template <class Real>
struct LinkVelocity3 {
  Real normal;
  Real3<Real> tangential, rolling;
};

// The adjoint of LinkVelocity3: force on j (opposite on i) and the two moments from (N, T, M).
template <class Real>
struct LinkLoad3 {
  Real3<Real> force;               // on j
  Real3<Real> moment_i, moment_j;  // about the centres
};

// r = r_ij including the image shift; one division serves 1/distance and 1/radius_sum.
template <class Real>
inline PairFrame3<Real> pair_frame(const Real3<Real>& r, Real radius_sum) {
  using std::sqrt;
  const Real distance = sqrt(dot_3d<Real>(r, r));
  const Real q = Real(1.0) / (distance * radius_sum);
  const Real inverse = q * radius_sum;
  return {{r[0] * inverse, r[1] * inverse, r[2] * inverse}, distance, distance - radius_sum, q * distance * distance};
}

template <class Real>
inline LinkFrame3<Real> link_frame(const Real3<Real>& r, Real radius_i, Real radius_j) {
  const PairFrame3<Real> f = pair_frame<Real>(r, radius_i + radius_j);
  return {f, f.lever_ratio * radius_i, f.lever_ratio * radius_j};
}

// dv = v_j - v_i, surface_sum = R_i w_i + R_j w_j, spin_difference = w_j - w_i.
template <class Real>
inline LinkVelocity3<Real> pair_velocity(const PairFrame3<Real>& f, const Real3<Real>& dv,
                                         const Real3<Real>& surface_sum, const Real3<Real>& spin_difference) {
  const Real normal = dot_3d<Real>(f.n, dv);
  const Real3<Real> turn = cross_3d<Real>(surface_sum, f.n);
  LinkVelocity3<Real> v{normal, {}, spin_difference};
  for (std::size_t k = 0; k < 3; ++k) v.tangential[k] = dv[k] - normal * f.n[k] - f.lever_ratio * turn[k];
  return v;
}

template <class Real>
inline LinkVelocity3<Real> link_velocity(const LinkFrame3<Real>& f, const Real3<Real>& dv, const Real3<Real>& spin_i,
                                         const Real3<Real>& spin_j) {
  const Real normal = dot_3d<Real>(f.n, dv);
  Real3<Real> turn, rolling;
  for (std::size_t k = 0; k < 3; ++k) {
    turn[k] = f.lever_i * spin_i[k] + f.lever_j * spin_j[k];
    rolling[k] = spin_j[k] - spin_i[k];
  }
  turn = cross_3d<Real>(turn, f.n);
  LinkVelocity3<Real> v{normal, {}, rolling};
  for (std::size_t k = 0; k < 3; ++k) v.tangential[k] = dv[k] - normal * f.n[k] - turn[k];
  return v;
}

// T normal to n: what it has along n adds to the force and not to the moments.
template <class Real>
inline LinkLoad3<Real> link_load(const LinkFrame3<Real>& f, Real normal, const Real3<Real>& tangential,
                                 const Real3<Real>& moment) {
  const Real3<Real> turn = cross_3d<Real>(f.n, tangential);
  LinkLoad3<Real> load;
  for (std::size_t k = 0; k < 3; ++k) {
    load.force[k] = normal * f.n[k] + tangential[k];
    load.moment_i[k] = -(f.lever_i * turn[k]) - moment[k];
    load.moment_j[k] = moment[k] - f.lever_j * turn[k];
  }
  return load;
}

// Loads of unit link forces times a positive factor that leaves no root: rational in r_ij and the radii, so that an
// exact field can take them (link.hpp). A contact with friction transmits any force at its point: its rows are the
// three Cartesian components of v_c, and n . v_c is a combination of them.
template <class Real>
inline LinkLoad3<Real> rational_normal(const Real3<Real>& r) {  // times |r|
  return {r, {}, {}};
}
template <class Real>
inline LinkLoad3<Real> rational_contact(std::size_t axis, const Real3<Real>& r, Real radius_i,
                                        Real radius_j) {  // times R_i + R_j
  LinkLoad3<Real> load{};
  Real3<Real> unit{};
  unit[axis] = Real(1);
  const Real3<Real> turn = cross_3d<Real>(r, unit);
  load.force[axis] = radius_i + radius_j;
  for (std::size_t k = 0; k < 3; ++k) {
    load.moment_i[k] = -(radius_i * turn[k]);
    load.moment_j[k] = -(radius_j * turn[k]);
  }
  return load;
}
template <class Real>
inline LinkLoad3<Real> rational_rolling(std::size_t axis) {  // as it is
  LinkLoad3<Real> load{};
  load.moment_i[axis] = -Real(1);
  load.moment_j[axis] = Real(1);
  return load;
}

}  // namespace isostat
