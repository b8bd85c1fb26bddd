// What the user asks for of disks: grains, law and units (dem/scene/scene.hpp has the tables common to all systems).
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "dem/scene/arrangement.hpp"
#include "dem/scene/sizes.hpp"

namespace isostat {

// [grains]: N disks, by default of diameters uniform in [diameter_min, diameter_max], in random non-overlapping
// positions (the I-state of Gilabert 2007, Sec. III.A); or two that collide.
struct GrainsScene : SizesScene {
  int count = 1400;
  double solid_fraction = 0.36;  // [-] Phi_I, with sum of pi d^2 / 4 over the cell's area
  Arrangement arrangement = Arrangement::random;
  double speed = 1;         // [a/T0] of the left disk of a collision, along x
  double offset = 0.5;      // [diameter_max] by which it is higher
  std::string file;         // a packing to start from instead; empty: none
  std::vector<double> box;  // [a] edges of the cell of a file that has none; empty: it stays isolated
  friend bool operator==(const GrainsScene&, const GrainsScene&) = default;
};

// [law]: the interaction law, Gilabert 2007, Eqs. 4-10 and Table I.
struct LawScene {
  double normal_stiffness = 1e5;               // K_N [F0/a]
  std::optional<double> tangential_stiffness;  // K_T [F0/a], default K_N
  double damping = 0.8;                        // zeta [-], fraction of the critical damping of the pair (Eq. 6)
  double friction = 0.5;                       // mu [-]
  bool rolling = true;                         // rolling resistance on
  std::optional<double> rolling_friction;      // mu_r [a], default 0.01 mu a
  std::optional<double> rolling_stiffness;     // K_r [F0 a], default 1e-4 a^2 K_N
  double attraction = 1.0;                     // F0 [F0]; 0: no cohesion
  double attraction_range = 1e-3;              // D0 [a]
  friend bool operator==(const LawScene&, const LawScene&) = default;
};

// [units]: maps the reduced run to SI in reports; absent: reduced.
struct UnitsScene {
  double length = 1.0;   // a [m]
  double density = 1.0;  // mass per area of the disks [kg/m^2] (2D)
  double force = 1.0;    // F0 [N]
  friend bool operator==(const UnitsScene&, const UnitsScene&) = default;
};

}  // namespace isostat
