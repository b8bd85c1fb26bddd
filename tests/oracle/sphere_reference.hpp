// The law of two spheres and of one step of their springs, written plainly from the formulas (Hertz; Mindlin and Tsuji,
// Tanaka, Ishida 1992; PHYSICS.md sec. 3), vectors in doubles, turns by exact rotations. Shares no code with the
// kernels.
#pragma once
#include "dem/spheres/spheres.hpp"

namespace isostat::oracle {

// One pair at one instant, with everything its law can ask for.
struct SpherePairMoment {
  Vec3 r{};                           // branch vector [a]
  double radius_i = 0, radius_j = 0;  // [a]
  double mass_i = 0, mass_j = 0;      // [m]
  Vec3 half_velocity{};               // v_j - v_i at the half step, affine part included [a/T0]
  Vec3 velocity{};                    // the same predicted to the full step
  Vec3 half_spin_i{}, half_spin_j{};  // [1/T0]
  Vec3 spin_i{}, spin_j{};            // predicted
  Vec3 tangential{}, moment{};        // springs before the step
  double time_step = 0;
};

struct SpherePairResponse {
  double gap = 0;
  Vec3 force{};                 // on j
  Vec3 moment_i{}, moment_j{};  // about the centres
  Vec3 tangential{}, moment{};  // springs after the step
};
SpherePairResponse pair_response(const SphereLaw& law, const SpherePairMoment& pair);

}  // namespace isostat::oracle
