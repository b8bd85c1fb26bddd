#include "dem/spheres/sphere_law.hpp"

namespace isostat {

SphereLaw resolve(const SphereLawScene& law) {
  SphereLaw p;
  p.normal = law.normal;
  if (law.normal == NormalForce::hertz) {
    p.grain = {law.modulus, law.poisson};
    p.wall = {law.wall_modulus.value_or(law.modulus), law.wall_poisson.value_or(law.poisson)};
  } else {
    p.normal_stiffness = law.normal_stiffness;
  }
  p.damping = law.damping;
  p.tangential_damping = law.damping > 0 && law.friction > 0 ? law.tangential_damping : 0.0;
  p.friction = law.friction, p.wall_friction = law.wall_friction.value_or(law.friction);
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

namespace {
SoftParticleLaw soft_law(const std::vector<double>& x) { return {x[0], x[1], x[2], x[3], x[4], x[5]}; }
}  // namespace

SphereLaw resolve(const SphereGrainsScene& grains, const SphereLawScene& law) {
  SphereLaw p = resolve(law);
  if (grains.second_share > 0 || !grains.file.empty())
    p.second = {law.second_modulus.value_or(law.modulus), law.second_poisson.value_or(law.poisson)};
  if (grains.soft_share > 0 || !grains.file.empty()) {
    p.soft_solid = soft_law(law.soft_solid), p.soft_soft = soft_law(law.soft_soft);
    p.soft_curvature = law.soft_curvature;
  }
  return p;
}

SphereLaw without_unlike(SphereLaw law) {
  law.second = {}, law.soft_solid = law.soft_soft = {}, law.soft_curvature = 0;
  return law;
}

}  // namespace isostat
