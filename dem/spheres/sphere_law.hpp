// The spheres' law with every default filled in: what kernels and analysis use. A zero means the axis is absent.
//
// Normal, of the overlap -h > 0:  Hertz  N_e = 4/3 E* sqrt(R*) (-h)^(3/2), 1/R* = 1/R_i + 1/R_j, 1/E* = (1 -
// nu_i^2)/E_i + (1 - nu_j^2)/E_j;  linear  N_e = K_N (-h). Tangential: dT = -k_T du, Hertz k_T = 8 G* sqrt(R* (-h)),
// 1/G* = (2 - nu_i)/G_i + (2 - nu_j)/G_j (Tsuji, Tanaka, Ishida 1992; Mindlin), |T| <= mu N_e. Attraction as of disks
// (Gilabert 2007, Eq. 4).
#pragma once
#include <cstdint>
#include <vector>

#include "dem/spheres/scene.hpp"

namespace isostat {

struct SphereMaterial {
  double modulus = 0, poisson = 0;  // E [F0/a^2], nu [-]
  friend bool operator==(const SphereMaterial&, const SphereMaterial&) = default;
};

// What a body is to the law. A shell is a rigid cavity around the grains of its group: a sphere of negative radius,
// which its grains touch from within, and nothing else does.
enum class SphereKind : std::uint8_t { grain, second, soft, shell };

// The measured contact of a soft-particle (seed 000, Eqs. 7, 8) in units of its radius R_s and the grains' modulus E:
// with the scaled deformation x = d/R_s
//   N_e = E R_s^2 max(0, force x^exponent + offset),  delta = (-offset/force)^(1/exponent)
//   k_T = E R_s max(0, tangential (x^tangential_exponent - delta^tangential_exponent)),  |T| <= friction N_e
struct SoftParticleLaw {
  double force = 0, exponent = 1, offset = 0;      // [-]
  double tangential = 0, tangential_exponent = 1;  // [-]
  double friction = 0;                             // [-]
  friend bool operator==(const SoftParticleLaw&, const SoftParticleLaw&) = default;
};

struct SphereLaw {
  NormalForce normal = NormalForce::hertz;
  SphereMaterial grain;   // Hertz
  SphereMaterial wall;    // of walls and shells; Hertz
  SphereMaterial second;  // of grains of a second material; Hertz
  SoftParticleLaw soft_solid, soft_soft;
  double soft_curvature = 0;        // q: a soft-particle meets a grain of radius R with (R/(R + R_s))^q times the force
  double normal_stiffness = 0;      // K_N [F0/a], linear
  double tangential_stiffness = 0;  // K_T [F0/a], linear
  double damping = 0;               // zeta [-]
  double tangential_damping = 0;    // [-] of the normal damping coefficient
  double friction = 0;              // mu [-]
  double wall_friction = 0;         // mu [-] at walls and shells
  double rolling_friction = 0;      // mu_r [a]
  double rolling_stiffness = 0;     // K_r [F0 a]
  double attraction = 0;            // F0 [F0]
  double attraction_range = 0;      // D0 [a]
  friend bool operator==(const SphereLaw&, const SphereLaw&) = default;
};
SphereLaw resolve(const SphereLawScene& law);                                   // of grains of one material
SphereLaw resolve(const SphereGrainsScene& grains, const SphereLawScene& law);  // and of what else there may be
SphereLaw without_unlike(SphereLaw law);                                        // of grains of one material again

}  // namespace isostat
