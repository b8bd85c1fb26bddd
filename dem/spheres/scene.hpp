// What the user asks for of spheres: grains, law and materials (dem/scene/scene.hpp has the tables common to all
// systems). Units are any consistent set: reduced (a, m, F0), or SI with a = 1 m, m = 1 kg, F0 = 1 N and T0 = 1 s.
#pragma once
#include <array>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dem/scene/sizes.hpp"

namespace isostat {

// Where spheres begin: N of them at random in a periodic cell; by hierarchical insertion (dem/sample/insertion.hpp) in
// a cell of given edge; or in a rigid shell, a soft-particle (seed 000), that touches a wall or another one below it.
enum class SphereArrangement { random, insertion, soft_wall, soft_pair };
inline constexpr std::array<std::string_view, 4> kSphereArrangementNames{"random", "insertion", "soft-particle-wall",
                                                                         "soft-particle-pair"};

// [grains]
struct SphereGrainsScene : SizesScene {
  SphereArrangement arrangement = SphereArrangement::random;
  double edge = 8;                          // [a] of the cell, by insertion
  double shell_radius = 1;                  // R_s [a] of a soft-particle
  double volume_factor = 3;                 // beta: volume of the listed grains over that of the room, by insertion
  double trials = 3e4;                      // I: random points tried for each grain, by insertion
  std::optional<double> inserted_fraction;  // [-] reached by the choice of I, by insertion
  int count = 1000;
  double solid_fraction = 0.3;            // [-] Phi_I
  double density = 6 / std::numbers::pi;  // [m/a^3] a sphere of diameter a has the mass m
  double second_share = 0;                // of the grains, by number, are of the second material
  std::optional<double> second_density;   // [m/a^3] of them; absent: density
  double soft_share = 0;                  // of the volume belongs to soft-particles
  double soft_radius = 0;                 // R_s [a] of theirs
  std::optional<double> soft_density;     // [m/a^3] of what one holds over the volume of its shell; absent: .7 density
  std::string file;                       // a packing to start from instead; empty: random
  std::vector<double> box;                // [a] edges of the cell of a file that has none; empty: it stays isolated
  friend bool operator==(const SphereGrainsScene&, const SphereGrainsScene&) = default;
};

enum class NormalForce { hertz, linear };
inline constexpr std::array<std::string_view, 2> kNormalForceNames{"hertz", "linear"};

// [law] of spheres.
struct SphereLawScene {
  NormalForce normal = NormalForce::hertz;
  double modulus = 1e5;                        // E [F0/a^2], Hertz
  double poisson = 0.3;                        // nu [-], Hertz
  double normal_stiffness = 1e5;               // K_N [F0/a], linear
  std::optional<double> tangential_stiffness;  // K_T [F0/a], linear; default K_N
  double damping = 0.3;                        // zeta [-] of the critical damping of the pair at its overlap
  double tangential_damping = 0.5;             // [-] of the normal damping coefficient; the force is capped by Coulomb
  double friction = 0.3;                       // mu [-]
  bool rolling = false;                        // rolling resistance on
  std::optional<double> rolling_friction;      // mu_r [a], default 0.01 mu a
  std::optional<double> rolling_stiffness;     // K_r [F0 a], default 1e-4 a^2 K_N
  double attraction = 0.0;                     // F0 [F0]; 0: no cohesion
  double attraction_range = 1e-3;              // D0 [a]
  std::optional<double> wall_modulus, wall_poisson, wall_friction;  // of walls; absent: as of the grains
  std::optional<double> second_modulus, second_poisson;             // of the second material; absent: the first's
  // Of soft-particles, the numbers of SoftParticleLaw in their order. By default seed 000's Tables 1 and 2 over E R_s^2
  // and E R_s, with the friction that we measured (docs/measured/spheres.md).
  std::vector<double> soft_solid{0.5755, 2.799, -2.734e-4, 0.3312, 2.100, 0.18};
  std::vector<double> soft_soft{0.2228, 5.003, -1.56e-5, 0.4396, 4.422, 0.44};
  double soft_curvature = 0;
  friend bool operator==(const SphereLawScene&, const SphereLawScene&) = default;
};

}  // namespace isostat
