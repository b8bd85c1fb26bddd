// The disks' law at rest (Gilabert 2007, Eqs. 4-10), written once: certificate, snapshots, energies, stiffness, static
// solves and lab ask here. The kernels evaluate the same law for batches of pairs in motion (dem/disks/kernel); tests
// hold the two together.
#pragma once
#include <cmath>

#include "dem/disks/disk_law.hpp"
#include "dem/state/packing.hpp"

namespace isostat {

// A contact counts as yielded when |T| >= (1 - kYieldTolerance) mu N_e, and the same for the rolling moment.
inline constexpr double kYieldTolerance = 1e-6;

// The normal law at the gap h.
struct AtRest {
  double force = 0;      // N(h) [F0], repulsion positive
  double stiffness = 0;  // -dN/dh [F0/a]
  double elastic = 0;    // energy of the repulsion, K_N h^2/2 [F0 a]
  double adhesive = 0;   // energy of the attraction [F0 a]; 0 out of its reach
};

// Its two branches, whatever the gap: of a contact, N = -K_N h - F0, and of a distant link within reach,
// N = -F0 (1 - h/D0).
inline AtRest contact(const DiskLaw& law, double gap) {
  return {-law.normal_stiffness * gap - law.attraction, law.normal_stiffness, 0.5 * law.normal_stiffness * gap * gap,
          -(law.attraction * (0.5 * law.attraction_range - gap))};
}
inline AtRest distant(const DiskLaw& law, double gap) {
  const double range = law.attraction_range, reach = range - gap;
  return {-law.attraction * (1 - gap / range), -law.attraction / range, 0,
          -(0.5 * law.attraction * reach * reach / range)};
}
// By the gap; nothing beyond D0.
inline AtRest at_rest(const DiskLaw& law, double gap) {
  if (gap < 0) return contact(law, gap);
  if (law.attraction > 0 && gap <= law.attraction_range) return distant(law, gap);
  return {};
}

// N_e = -K_N h, what the Coulomb and rolling limits act on (Eqs. 8, 10) [F0].
inline double repulsion(const DiskLaw& law, double gap) { return -law.normal_stiffness * gap; }
struct Limits {
  double tangential = 0, rolling = 0;  // mu N_e [F0], mu_r N_e [F0 a]
};
inline Limits limits(const DiskLaw& law, double gap) {
  const double elastic = repulsion(law, gap);
  return {law.friction * elastic, law.rolling_friction * elastic};
}

// How far a contact is from yielding: 1 - |T| / (mu N_e) and 1 - |M| / (mu_r N_e).
struct YieldMargin {
  double sliding = 1, rolling = 1;  // [-] 1 where the axis is absent; 0 at the limit; 0 if N_e <= 0
};
inline YieldMargin yield_margin(const DiskLaw& law, double gap, double tangential_force, double moment) {
  const auto margin = [](double coefficient, double limit, double force) {
    if (coefficient <= 0) return 1.0;  // the axis is absent
    return limit > 0 ? 1 - std::abs(force) / limit : 0.0;
  };
  const Limits most = limits(law, gap);
  return {margin(law.friction, most.tangential, tangential_force), margin(law.rolling_friction, most.rolling, moment)};
}

// Kind of a link of a state: distant for gap >= 0, else by the yield margins.
inline LinkKind kind_of(const DiskLaw& law, double gap, double tangential_force, double moment) {
  if (!(gap < 0)) return LinkKind::distant;
  const YieldMargin m = yield_margin(law, gap, tangential_force, moment);
  const bool slides = m.sliding <= kYieldTolerance, rolls = m.rolling <= kYieldTolerance;
  if (slides) return rolls ? LinkKind::both_yielded : LinkKind::sliding;
  return rolls ? LinkKind::rolling_yielded : LinkKind::closed;
}

// Energy of the springs of friction and rolling, T^2/(2 K_T) and M^2/(2 K_r) [F0 a].
struct SpringEnergy {
  double tangential = 0, rolling = 0;
};
inline SpringEnergy spring_energy(const DiskLaw& law, double tangential_force, double moment) {
  const auto stored = [](double force, double stiffness) {
    return stiffness > 0 ? 0.5 * force * force / stiffness : 0.0;
  };
  return {stored(tangential_force, law.tangential_stiffness), stored(moment, law.rolling_stiffness)};
}

}  // namespace isostat
