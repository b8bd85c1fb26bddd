// The largest time step at which every small motion of a free grain decays: spectral radius of the update map of its
// elastic and damped motions. Contacts stiffen a grain further (by a third in a bed of squares, TRIANGLES.md 5).
#pragma once
#include <cstddef>

#include "dem/scene/scene.hpp"
#include "dem/triangles/grain_template.hpp"

namespace isostat {

// Growth of an amplitude per step that still counts as stable: a factor e in 1e4 steps. It matters without dampers
// only, where Gear's scheme has no stable step in the strict sense (an oscillation grows by about 0.06 (omega dt)^6 a
// step).
inline constexpr double kStableGrowth = 1e-4;
inline constexpr std::size_t kMostTrianglesOfAStep = 100;  // eigenvalues of maps of 15 rows a triangle: minutes

// What the dampers see when velocity Verlet needs v(n) and knows v(n-1/2): of every velocity the extrapolation
// v(n-1/2) + a(n-1) dt/2, but of spins ...
enum class SpinInDampers {
  torque,            // the torque on a body: the mean of its own spin over the step; the force across the beam: not
  torque_and_force,  // torque and force alike, so that the dampers' forces balance: angular momentum to rounding
};

struct StableStep {   // [s]; infinite for a grain without beams
  double gear = 0;    // fourth order, forces at predicted positions and velocities (dem/triangles/gear_scheme.hpp)
  double verlet = 0;  // with the spin taken as asked
};
// Throws InputError for a grain of more triangles than kMostTrianglesOfAStep.
StableStep stable_step(const GrainTemplate& grain, SpinInDampers spin = SpinInDampers::torque);

// Of one scheme, the engine's: with torque_and_force or Gear's. From the two dozen fastest motions alone, within a few
// per cent of the limit with all of them, in milliseconds: what a scene is held to.
double stable_step_estimate(const GrainTemplate& grain, Integrator integrator);

}  // namespace isostat
