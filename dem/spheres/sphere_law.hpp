// The spheres' law with every default filled in: what kernels and analysis use. A zero means the axis is absent.
//
// Normal, of the overlap -h > 0:  Hertz  N_e = 4/3 E* sqrt(R*) (-h)^(3/2), 1/R* = 1/R_i + 1/R_j, 1/E* = (1 -
// nu_i^2)/E_i + (1 - nu_j^2)/E_j;  linear  N_e = K_N (-h). Tangential: dT = -k_T du, Hertz k_T = 8 G* sqrt(R* (-h)),
// 1/G* = (2 - nu_i)/G_i + (2 - nu_j)/G_j (Tsuji, Tanaka, Ishida 1992; Mindlin), |T| <= mu N_e. Attraction as of disks
// (Gilabert 2007, Eq. 4).
#pragma once
#include <vector>

#include "dem/spheres/scene.hpp"

namespace isostat {

struct SphereMaterial {
  double modulus = 0, poisson = 0;  // E [F0/a^2], nu [-]
  friend bool operator==(const SphereMaterial&, const SphereMaterial&) = default;
};

struct SphereLaw {
  NormalForce normal = NormalForce::hertz;
  SphereMaterial grain;             // Hertz
  SphereMaterial wall;              // of walls and shells; Hertz
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
SphereLaw resolve(const SphereLawScene& law);

}  // namespace isostat
