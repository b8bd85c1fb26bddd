#include "dem/disks/disk_law.hpp"

namespace isostat {

DiskLaw resolve(const LawScene& law) {
  DiskLaw p;
  p.normal_stiffness = law.normal_stiffness;
  p.damping = law.damping;
  p.friction = law.friction;
  p.tangential_stiffness = law.friction > 0 ? law.tangential_stiffness.value_or(law.normal_stiffness) : 0.0;
  if (law.rolling) {
    p.rolling_friction = law.rolling_friction.value_or(0.01 * law.friction);
    p.rolling_stiffness = p.rolling_friction > 0 ? law.rolling_stiffness.value_or(1e-4 * law.normal_stiffness) : 0.0;
  }
  if (law.attraction > 0) {
    p.attraction = law.attraction;
    p.attraction_range = law.attraction_range;
  }
  return p;
}

}  // namespace isostat
