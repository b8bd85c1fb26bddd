// Motion of the spheres over one step: leapfrog as of disks (dem/disks/motion.hpp), with velocity and spin at half
// steps, and both predicted to the full step for the viscous forces.
//
//   u(n+1/2) = u(n-1/2) + dt F(n)/m,   x(n+1) = x(n) + dt u(n+1/2),   p(n+1) = u(n+1/2) + prediction dt F(n)/m
// and the same with spin and moment. A sphere needs no orientation.
#pragma once
#include <array>
#include <cstddef>

#include "dem/solver/isa.hpp"
#include "dem/solver/motion_step.hpp"
#include "dem/spheres/sphere_law.hpp"
#include "dem/spheres/sphere_store.hpp"

namespace isostat {

// How far ahead of the half step damping can look [dt]: 1/2, exact to second order, where that is stable, else less.
// stiffest [1/T0^2]: the largest k_N/m of a contact and the lighter of its grains. The condition and its reason are
// those of disks (w^2 dt^2/2 + g dt (1 + 2 prediction) < 2), put to the stiffest mode of a lattice of such grains in
// space: w^2 = 8 k_N/m, g = 8 sqrt(2) zeta sqrt(k_N/m) (face-centred cubic).
double velocity_prediction(const SphereLaw& law, double stiffest, double time_step);

struct SphereMotionTally {
  double largest_speed_squared = 0;  // [a^2/T0^2] bound on that of u(n+1/2)
  std::array<double, 3> kinetic{};   // sum of m p_a^2 [F0 a], for the stress of a free cell
  double shear_kinetic = 0;          // sum of m p_1 p_2, of one that shears
};

// Which instance of the step a scene needs: a frictionless one turns nothing, a fixed cell scales nothing, and few
// cells shear.
struct SphereMotionNeeds {
  bool rotation = true, free_cell = true;
  bool moments = false;  // the store's moments are not all zero
  bool shear = false;    // of a free cell
};
// The store's arrays; raw, so that no inline function of its is compiled for one instruction set.
struct SphereArrays {
  double *rows, *loads, *spins, *moments;
  const SphereConstants* constants;
};
inline SphereArrays arrays_of(SphereStore& s) {
  return {s.rows.data(), s.loads.data(), s.spins.data(), s.moments.data(), s.constants.data()};
}
// prediction [dt]: how far p is ahead of u. gravity [a/T0^2]: the loads of the next forces begin with the weights,
// along -z.
using SphereMotionKernel = SphereMotionTally (*)(const SphereArrays&, std::size_t begin, std::size_t end,
                                                 const MotionStep<3>&, double prediction, double gravity);
SphereMotionKernel select_motion(SphereMotionNeeds needs, Isa isa);

}  // namespace isostat
