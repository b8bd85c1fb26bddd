// What the laws at rest of all systems of grains answer with: normal force and its energies, limits of friction and
// rolling, and how far a contact is from them.
#pragma once
#include <cmath>

#include "dem/state/packing.hpp"

namespace isostat {

// A contact counts as yielded when |T| >= (1 - kYieldTolerance) mu N_e, and the same for the rolling moment.
inline constexpr double kYieldTolerance = 1e-6;

// The normal law at the gap h.
struct AtRest {
  double force = 0;      // N(h) [F0], repulsion positive
  double stiffness = 0;  // -dN/dh [F0/a]
  double elastic = 0;    // energy of the repulsion [F0 a]
  double adhesive = 0;   // energy of the attraction [F0 a]; 0 out of its reach
};

struct Limits {
  double tangential = 0, rolling = 0;  // mu N_e [F0], mu_r N_e [F0 a]
};

// How far a contact is from yielding: 1 - |T| / (mu N_e) and 1 - |M| / (mu_r N_e).
struct YieldMargin {
  double sliding = 1, rolling = 1;  // [-] 1 where the axis is absent; 0 at the limit; 0 if N_e <= 0
};

// Of one axis: its coefficient (0: absent), the limit, and the size of force or moment.
inline double yield_margin(double coefficient, double limit, double size) {
  if (coefficient <= 0) return 1.0;
  return limit > 0 ? 1 - size / limit : 0.0;
}

// Kind of a link of a state: distant for gap >= 0, else by the yield margins.
inline LinkKind link_kind(double gap, const YieldMargin& m) {
  if (!(gap < 0)) return LinkKind::distant;
  const bool slides = m.sliding <= kYieldTolerance, rolls = m.rolling <= kYieldTolerance;
  if (slides) return rolls ? LinkKind::both_yielded : LinkKind::sliding;
  return rolls ? LinkKind::rolling_yielded : LinkKind::closed;
}

// Energy of the springs of friction and rolling, T^2/(2 k_T) and M^2/(2 K_r) [F0 a].
struct SpringEnergy {
  double tangential = 0, rolling = 0;
};
inline double stored_energy(double force, double stiffness) {
  return stiffness > 0 ? 0.5 * force * force / stiffness : 0.0;
}

}  // namespace isostat
