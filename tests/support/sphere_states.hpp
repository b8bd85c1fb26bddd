// States and laws of spheres for tests of the solver: a few by hand, and random ones, moving, turning, overlapping.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "dem/solver/random.hpp"
#include "dem/spheres/at_rest.hpp"
#include "dem/spheres/spheres.hpp"

namespace isostat::oracle {

// Soft enough for violent random states, with every axis on and a long attraction.
SphereLaw soft_sphere_law(NormalForce normal = NormalForce::hertz);
// Every composition that a kernel exists for.
std::vector<SphereLaw> sphere_laws();
std::string words(const SphereLaw& law);

// Adds a sphere of density 6/pi; gives its index.
std::size_t add_sphere(SpherePacking& packing, double radius, const Vec3& position, const Vec3& velocity = {},
                       const Vec3& spin = {});

struct RandomSpheres {
  int count = 60;
  double room = 1.0;  // [a^3] of the cell for a sphere: .5 is dense
  double radius_min = 0.25, radius_max = 0.5;
  double speed = 1, spin = 2;  // [a/T0], [1/T0] scale of the velocities
  double time_step = 1e-3;
  bool cell = true;
  SphereLaw law = soft_sphere_law();
  std::uint64_t seed = 1;
};
// Spheres on a perturbed lattice, so that they overlap a little here and there.
State<Spheres> random_state(const RandomSpheres& r);

double total_mass(const State<Spheres>& state);

}  // namespace isostat::oracle
