// The disks' law at rest (Gilabert 2007, Eqs. 4-10), written once: certificate, snapshots, energies, stiffness, static
// solves and lab ask here. The kernels evaluate the same law for batches of pairs in motion (dem/disks/kernel); tests
// hold the two together.
#pragma once
#include <cmath>

#include "dem/disks/disk_law.hpp"
#include "dem/state/yield.hpp"

namespace isostat {

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
inline Limits limits(const DiskLaw& law, double gap) {
  const double elastic = repulsion(law, gap);
  return {law.friction * elastic, law.rolling_friction * elastic};
}

inline YieldMargin yield_margin(const DiskLaw& law, double gap, double tangential_force, double moment) {
  const Limits most = limits(law, gap);
  return {yield_margin(law.friction, most.tangential, std::abs(tangential_force)),
          yield_margin(law.rolling_friction, most.rolling, std::abs(moment))};
}

inline LinkKind kind_of(const DiskLaw& law, double gap, double tangential_force, double moment) {
  return link_kind(gap, yield_margin(law, gap, tangential_force, moment));
}

inline SpringEnergy spring_energy(const DiskLaw& law, double tangential_force, double moment) {
  return {stored_energy(tangential_force, law.tangential_stiffness), stored_energy(moment, law.rolling_stiffness)};
}

}  // namespace isostat
