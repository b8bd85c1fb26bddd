// The disks' law with every default filled in.
#pragma once
#include "dem/disks/scene.hpp"

namespace isostat {

// The law with every default filled in: what kernels and analysis use. A zero means the axis is absent.
struct DiskLaw {
  double normal_stiffness = 0;      // K_N [F0/a]
  double tangential_stiffness = 0;  // K_T [F0/a]
  double damping = 0;               // zeta [-]
  double friction = 0;              // mu [-]
  double rolling_friction = 0;      // mu_r [a]; 0: no rolling resistance
  double rolling_stiffness = 0;     // K_r [F0 a]
  double attraction = 0;            // F0 [F0]; 0: no cohesion
  double attraction_range = 0;      // D0 [a]; 0 without cohesion
};
DiskLaw resolve(const LawScene& law);

}  // namespace isostat
