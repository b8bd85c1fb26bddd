// The model that soft-particles were made for (seed 000, Secs. 1, 2): a packing of solid grains and soft-particles, in
// a periodic cube that is compressed step by step, and the same with every grain of the soft-particles in it. A
// soft-particle stands for a packing of grains in a rigid shell; three resolutions of one packing:
//   model   soft-particles are single bodies under their measured laws
//   shells  each is its grains in a rigid shell that moves freely: what the laws were measured on
//   free    the grains without shells: what the shells stand for
#pragma once
#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "dem/sample/insertion_scene.hpp"
#include "dem/spheres/spheres.hpp"

namespace isostat {

enum class SoftResolution { model, shells, free };
inline constexpr std::array<std::string_view, 3> kSoftResolutionNames{"model", "shells", "free"};

struct SoftPackingTest {
  InsertionScene packing;      // of the cube: soft_radius and soft_share say which soft-particles are in it
  InsertionScene inside;       // of each soft-particle: shell_radius is the soft_radius of the packing
  SphereLaw law;               // with the laws of soft-particles, for the model
  double density = 2500;       // of the grains
  std::vector<double> strain;  // ascending: 1 - L/L0 at which forces are taken
  double increment = 2.5e-3;   // most strain between two relaxations
  double speed = 0.05;         // of the edges of the cube while it shrinks
  double residual = 1e-3;      // FIRE (dem/spheres/lab/fire.hpp)
  int most_iterations = 3000;
  double step = 2;  // in units of the stable one, of the smallest grain (time_step_unit)
};

struct SoftPackingPoint {
  double strain = 0;
  double pressure = 0;             // a third of the trace of the stress
  double residual = 0;             // FIRE's
  std::vector<double> solid_load;  // of each solid grain, in the order of insertion: mean pressure on it
};
struct SoftPackingRun {
  std::size_t solids = 0, softs = 0, bodies = 0;  // softs: soft-particles; bodies: that were marched
  double solid_fraction = 0;                      // of all solid grains at zero strain, those in soft-particles, too
  std::int64_t steps = 0;
  double cpu_seconds = 0;  // of the compression
  std::vector<SoftPackingPoint> points;
};

// A pure function of its arguments but for cpu_seconds; the packing of a seed is the same at each resolution. Throws
// InputError if it cannot be made, RunError if it blows up.
SoftPackingRun compress_soft_packing(const SoftPackingTest& test, SoftResolution resolution, std::uint64_t seed);

}  // namespace isostat
