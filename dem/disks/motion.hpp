// Motion of the bodies over one step: leapfrog with the velocity at half steps, and the prediction of the full-step
// velocity that the damping is evaluated with.
//
//   u(n+1/2) = u(n-1/2) + dt F(n)/m,   x(n+1) = x(n) + dt u(n+1/2),   p(n+1) = u(n+1/2) + dt/2 F(n)/m
// p is the velocity at n+1 to second order, so damping forces are second-order too (steps too large to be stable with
// that look less far ahead). Springs of friction and rolling are
// stretched by the half-step velocities, i.e. by the displacements themselves: that keeps them conservative.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "dem/disks/bodies_store.hpp"
#include "dem/disks/disk_law.hpp"
#include "dem/solver/motion_step.hpp"

namespace isostat {

// How far ahead of the half step damping can look [dt]. A half is exact to second order, but a force that depends on
// the previous one is unstable sooner: a mode of frequency w and damping rate g needs w^2 dt^2/2 + g dt (1 + 2
// prediction) < 2. The bound is put to the stiffest mode of a lattice of the smallest grains (w^2 = 6 K_N/m, every
// contact damped: g = 6 sqrt(2) zeta sqrt(K_N/m)); larger steps look less far ahead, down to the half step itself. zeta
// [-], mass of the smallest grain [m], dt [T0].
inline double velocity_prediction(const DiskLaw& law, double smallest_mass, double time_step) {
  const double s = time_step * std::sqrt(law.normal_stiffness / smallest_mass);
  const double damping = 6 * std::numbers::sqrt2 * law.damping * s;
  if (!(damping > 0)) return 0.5;
  return std::clamp(0.5 * ((2 - 3 * s * s) / damping - 1), 0.0, 0.5);
}

struct MotionTally {
  double largest_speed_squared = 0;  // [a^2/T0^2] bound on that of u(n+1/2)
  double kinetic[2] = {0, 0};        // sum of m p_a^2 [F0 a], for the stress of a free cell
  double shear_kinetic = 0;          // sum of m p_1 p_2, of one that shears
};

// Which instance of the step a scene needs: a frictionless one turns nothing, a fixed cell scales nothing, and few
// cells shear. Weight stands in no cell that moves.
struct MotionNeeds {
  bool rotation = true, free_cell = true, weight = false, shear = false;
};
// prediction [dt]: how far p is ahead of u, see velocity_prediction(). gravity [a/T0^2]: the loads of the next forces
// begin with the weights, along -y; 0 where none is needed.
using MotionKernel = MotionTally (*)(BodiesStore&, std::size_t begin, std::size_t end, const MotionStep<2>&,
                                     double prediction, double gravity);
MotionKernel select_motion(MotionNeeds needs);

}  // namespace isostat
