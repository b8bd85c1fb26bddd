// Measurements of soft-particles over several packings, and what is read from them.
#pragma once
#include <cstdint>
#include <vector>

#include "dem/spheres/lab/soft_particle.hpp"

namespace isostat {

// Packings of the seeds from `seed` on, side by side.
std::vector<SoftMeasurement> measure_soft_particles(const SoftParticleTest& test, std::uint64_t seed,
                                                    std::size_t packings, unsigned threads);

// Slopes of the tangential forces with the angle at each deformation, of one packing: least squares lines through all
// angles that were measured, [force/degree]; and the force along the slip before the rotation.
struct SoftSlopes {
  std::vector<double> along, across, prestrain;
};
SoftSlopes slopes_of(const SoftMeasurement& measurement, const std::vector<double>& deltas);

}  // namespace isostat
