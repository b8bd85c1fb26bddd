// The contact of a soft-particle with a grain, a wall or another soft-particle, by its measured laws
// (dem/spheres/sphere_law.hpp). Functions of one translation unit: kernels of every instruction set call the same code.
#pragma once
#include "dem/spheres/sphere_law.hpp"

namespace isostat {

// What the law is of one pair, units restored.
struct SoftContact {
  double radius = 0;             // R_s [a]; 0: not a soft contact
  double force = 0, offset = 0;  // [F0]
  double exponent = 1;
  double tangential = 0;  // [F0/a]
  double tangential_exponent = 1;
  double threshold = 0;             // delta [-]
  double tangential_threshold = 0;  // delta^tangential_exponent
};
// modulus E [F0/a^2]; share: what the curvature of the partner leaves of force and stiffness, 1 at a plane.
SoftContact soft_contact(const SoftParticleLaw& law, double modulus, double radius, double share);

// Of the overlap d [a]: N_e [F0] and its slope [F0/a], k_T [F0/a], and the work to press so far [F0 a].
struct SoftForce {
  double force = 0, stiffness = 0;
};
SoftForce soft_force(const SoftContact& c, double overlap);
double soft_tangential_stiffness(const SoftContact& c, double overlap);
double soft_energy(const SoftContact& c, double overlap);

}  // namespace isostat
