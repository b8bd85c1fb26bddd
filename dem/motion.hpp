// Motion of the bodies over one step: leapfrog with the velocity at half steps, and the prediction of the full-step
// velocity that the damping is evaluated with.
//
//   u(n+1/2) = u(n-1/2) + dt F(n)/m,   x(n+1) = x(n) + dt u(n+1/2),   p(n+1) = u(n+1/2) + dt/2 F(n)/m
// p is the velocity at n+1 to second order, so damping forces are second-order too. Springs of friction and rolling
// are stretched by the half-step velocities, i.e. by the displacements themselves: that keeps them conservative.
#pragma once
#include <cstddef>

#include "dem/bodies_store.hpp"

namespace isostat {

struct MotionStep {
  double time_step = 0;           // dt [T0]
  double scale[2] = {1, 1};       // L(n+1) / L(n): positions are rescaled with the cell
  double half_scale[2] = {1, 1};  // L(n+1) / L(n+1/2)
  double keep[2] = {1, 1};        // velocity kept over the step: 1 - drag dt (- rate coupling)
  double keep_spin = 1;
};

struct MotionTally {
  double largest_speed_squared = 0;  // [a^2/T0^2] bound on that of u(n+1/2)
  double kinetic[2] = {0, 0};        // sum of m p_a^2 [F0 a], for the stress of a free cell
};

// Which instance of the step a scene needs: a frictionless one turns nothing, a fixed cell scales nothing.
struct MotionNeeds {
  bool rotation = true, free_cell = true;
};
using MotionKernel = MotionTally (*)(BodiesStore&, std::size_t begin, std::size_t end, const MotionStep&);
MotionKernel select_motion(MotionNeeds needs);

}  // namespace isostat
