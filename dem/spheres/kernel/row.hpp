// How spheres lie in memory for the force kernels, and how W pairs of them are brought into registers.
//
// A body is one row of two cache lines  [x y z | p q s | u v w | Wx Wy Wz | Qx Qy Qz | -]:  position, predicted
// full-step velocity, half-step velocity, and the surface speeds R w at the half step and predicted. Frictionless
// kernels touch the first line alone. A pair needs the differences of the rows of j and i, but the sums of the surface
// speeds, so  j + sign * i  in one fused operation a line and one W x W transpose bring a batch of W pairs into lanes.
// A body's load is one cache line  [Fx Fy Fz | Ax Ay Az | - -]:  force, and the moment as R A + M (lever arms are
// proportional to R, see dem/state/link_3d.hpp). Rolling alone needs spins and M: rows of four, in arrays of their own.
// Lanes write back pair by pair, in list order: the sum on a body is the same whatever W is.
#pragma once
#include <cstdint>

#include "dem/state/link_3d.hpp"
#include "geometry/base/lanes.hpp"

namespace isostat::spheres {

namespace stdx = std::experimental;
using isostat::kernel::Native;
using isostat::kernel::Scalar;
using isostat::kernel::select;

inline constexpr int kRowWidth = 16, kLoadWidth = 8, kSpinWidth = 4;  // doubles
// Where triples begin in a row and in a load.
struct Slot {
  enum : std::uint8_t { position = 0, velocity = 3, half_velocity = 6, half_surface = 9, surface = 12 };
};
struct LoadSlot {
  enum : std::uint8_t { force = 0, moment_per_radius = 3 };
};

// Pairs name bodies by the offset of their row in doubles: body k is at rows[16 k], loads[8 k], spins[4 k].
using RowOffset = std::uint32_t;
template <int kWidth, class T>
ISOSTAT_INLINE T* row_at(T* first, RowOffset o) {
  return first + std::size_t{o} / (kRowWidth / kWidth);
}

template <class V>
struct PairDifference {                    // j minus i
  Real3<V> r, velocity, half_velocity;     // of the predicted and the half-step velocity
  Real3<V> half_surface_sum, surface_sum;  // R_i w_i + R_j w_j
};

ISOSTAT_INLINE Real3<Scalar> triple(const double* a, const double* b, double sign, int at) {
  return {Scalar(b[at] + sign * a[at]), Scalar(b[at + 1] + sign * a[at + 1]), Scalar(b[at + 2] + sign * a[at + 2])};
}

// Both lines of the rows, or with kFirstLine position and velocity alone.
template <bool kFirstLine>
ISOSTAT_INLINE PairDifference<Scalar> load_differences(const double* rows, const RowOffset* i, const RowOffset* j,
                                                       Scalar) {
  const double *a = row_at<kRowWidth>(rows, *i), *b = row_at<kRowWidth>(rows, *j);
  PairDifference<Scalar> d{triple(a, b, -1, Slot::position), triple(a, b, -1, Slot::velocity), {}, {}, {}};
  if constexpr (!kFirstLine) {
    d.half_velocity = triple(a, b, -1, Slot::half_velocity);
    d.half_surface_sum = triple(a, b, 1, Slot::half_surface);
    d.surface_sum = triple(a, b, 1, Slot::surface);
  }
  return d;
}
ISOSTAT_INLINE Real3<Scalar> load_spin_difference(const double* spins, const RowOffset* i, const RowOffset* j, Scalar) {
  return triple(row_at<kSpinWidth>(spins, *i), row_at<kSpinWidth>(spins, *j), -1, 0);
}

// table[codes[lane]]
ISOSTAT_INLINE Scalar look_up(const double* table, const std::uint8_t* codes, Scalar) { return Scalar(table[*codes]); }

// Force on j, opposite on i; moment per radius on both.
ISOSTAT_INLINE void add_loads(double* loads, const RowOffset* i, const RowOffset* j, const Real3<Scalar>& force,
                              const Real3<Scalar>& moment_per_radius) {
  double *on_i = row_at<kLoadWidth>(loads, *i), *on_j = row_at<kLoadWidth>(loads, *j);
  for (std::size_t k = 0; k < 3; ++k) {
    on_i[k] -= force[k][0], on_j[k] += force[k][0];
    on_i[3 + k] += moment_per_radius[k][0], on_j[3 + k] += moment_per_radius[k][0];
  }
}
ISOSTAT_INLINE void add_forces(double* loads, const RowOffset* i, const RowOffset* j, const Real3<Scalar>& force) {
  double *on_i = row_at<kLoadWidth>(loads, *i), *on_j = row_at<kLoadWidth>(loads, *j);
  for (std::size_t k = 0; k < 3; ++k) on_i[k] -= force[k][0], on_j[k] += force[k][0];
}
ISOSTAT_INLINE void add_moments(double* moments, const RowOffset* i, const RowOffset* j, const Real3<Scalar>& moment) {
  double *on_i = row_at<kSpinWidth>(moments, *i), *on_j = row_at<kSpinWidth>(moments, *j);
  for (std::size_t k = 0; k < 3; ++k) on_i[k] -= moment[k][0], on_j[k] += moment[k][0];
}

}  // namespace isostat::spheres

#if defined(__AVX512F__)
#include "dem/spheres/kernel/row_avx512.hpp"
#elif defined(__AVX2__)
#include "dem/spheres/kernel/row_avx2.hpp"
#endif
