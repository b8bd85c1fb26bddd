#include "dem/spheres/time_step.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dem/spheres/at_rest.hpp"

namespace isostat {
namespace {

double mass_of(double radius, double density) {
  return 4.0 / 3.0 * std::numbers::pi * density * radius * radius * radius;
}

}  // namespace

double stiffness_of_equal(const SphereLaw& law, double radius, double depth) {
  return normal_stiffness(law, pair_stiffness(law, radius, radius), -depth * radius);
}

double contact_time(const SphereLaw& law, double radius, double density) {
  return std::sqrt(mass_of(radius, density) / stiffness_of_equal(law, radius));
}

double shortest_contact_time(const Scene& scene, double smallest_radius) {
  const SphereGrainsScene& g = scene.sphere_grains;
  SphereLaw law = resolve(g, scene.sphere_law);
  double time = contact_time(law, smallest_radius, g.density);
  if (!(g.second_share > 0)) return time;
  law.grain = law.second;
  return std::min(time, contact_time(law, smallest_radius, g.second_density.value_or(g.density)));
}

double critical_fraction(const SphereLaw& law, double radius, double density) {
  const double mass = mass_of(radius, density), normal = stiffness_of_equal(law, radius);
  const double tangential =
      law.friction > 0 ? tangential_stiffness(law, pair_stiffness(law, radius, radius), -kReferenceOverlap * radius)
                       : 0.0;
  const double translation = 8 * (normal + 2 * tangential) / mass;
  const double rotation = 16 * (tangential + law.rolling_stiffness / (radius * radius)) / (0.4 * mass);
  return 2 / std::sqrt(std::max(translation, rotation)) * std::sqrt(normal / mass);
}

double critical_fraction(const Scene& scene, double smallest_radius) {
  const SphereGrainsScene& g = scene.sphere_grains;
  SphereLawScene stiffest = scene.sphere_law;
  for (const StageScene& s : scene.stages) stiffest.friction = std::max(stiffest.friction, s.friction.value_or(0));
  SphereLaw law = resolve(g, stiffest);
  const double bound = critical_fraction(law, smallest_radius, g.density);
  if (!(g.second_share > 0)) return bound;
  law.grain = law.second;
  return std::min(bound, critical_fraction(law, smallest_radius, g.density));
}

double step_fraction(const Scene& scene, double smallest_radius) {
  constexpr double kReference = 0.1, kOfBound = 0.5;
  return scene.step.fraction.value_or(std::min(kReference, kOfBound * critical_fraction(scene, smallest_radius)));
}

}  // namespace isostat
