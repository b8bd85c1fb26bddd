#include "dem/spheres/sphere_law.hpp"

namespace isostat {

SphereLaw resolve(const SphereLawScene& law) {
  SphereLaw p;
  p.normal = law.normal;
  if (law.normal == NormalForce::hertz)
    p.grain = p.wall = {law.modulus, law.poisson};
  else
    p.normal_stiffness = law.normal_stiffness;
  p.damping = law.damping;
  p.tangential_damping = law.damping > 0 && law.friction > 0 ? law.tangential_damping : 0.0;
  p.friction = p.wall_friction = law.friction;
  if (law.normal == NormalForce::linear && law.friction > 0)
    p.tangential_stiffness = law.tangential_stiffness.value_or(law.normal_stiffness);
  if (law.rolling) {
    const double stiffness = law.normal == NormalForce::hertz ? law.modulus : law.normal_stiffness;
    p.rolling_friction = law.rolling_friction.value_or(0.01 * law.friction);
    p.rolling_stiffness = p.rolling_friction > 0 ? law.rolling_stiffness.value_or(1e-4 * stiffness) : 0.0;
  }
  if (law.attraction > 0) {
    p.attraction = law.attraction;
    p.attraction_range = law.attraction_range;
  }
  return p;
}

}  // namespace isostat
