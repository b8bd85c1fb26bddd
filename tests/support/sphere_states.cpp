#include "tests/support/sphere_states.hpp"

#include <cmath>
#include <numbers>

namespace isostat::oracle {

SphereLaw soft_sphere_law(NormalForce normal) {
  SphereLaw law;
  law.normal = normal;
  if (normal == NormalForce::hertz)
    law.grain = law.wall = {1e3, 0.3};
  else
    law.normal_stiffness = 1e3, law.tangential_stiffness = 7e2;
  law.damping = 0.4, law.tangential_damping = 0.5;
  law.friction = law.wall_friction = 0.3;
  law.rolling_friction = 0.02, law.rolling_stiffness = 30;
  law.attraction = 2, law.attraction_range = 0.05;
  return law;
}

std::vector<SphereLaw> sphere_laws() {
  std::vector<SphereLaw> list;
  for (const NormalForce normal : {NormalForce::hertz, NormalForce::linear})
    for (const bool attracts : {false, true})
      for (const bool damped : {false, true})
        for (const int turning : {0, 1, 2}) {
          SphereLaw law = soft_sphere_law(normal);
          if (!attracts) law.attraction = law.attraction_range = 0;
          if (!damped) law.damping = law.tangential_damping = 0;
          if (turning == 0) law.friction = law.wall_friction = law.tangential_stiffness = 0;
          if (turning < 2) law.rolling_friction = law.rolling_stiffness = 0;
          list.push_back(law);
        }
  return list;
}

std::string words(const SphereLaw& law) {
  return std::string(law.normal == NormalForce::hertz ? "hertz" : "linear") + (law.attraction > 0 ? ", adhesion" : "") +
         (law.damping > 0 ? ", damping" : "") + (law.friction > 0 ? ", friction" : "") +
         (law.rolling_friction > 0 ? ", rolling" : "");
}

std::size_t add_sphere(SpherePacking& packing, double radius, const Vec3& position, const Vec3& velocity,
                       const Vec3& spin) {
  Bodies<3>& b = packing.bodies;
  const std::size_t k = b.size();
  b.resize(k + 1);
  b.id[k] = static_cast<std::int64_t>(k) + 1;
  b.radius[k] = radius, b.mass[k] = 8 * radius * radius * radius;
  b.inertia[k] = 0.4 * b.mass[k] * radius * radius;
  b.position[k] = position, b.velocity[k] = velocity, b.spin[k] = spin;
  return k;
}

State<Spheres> random_state(const RandomSpheres& r) {
  State<Spheres> s;
  Random random(r.seed);
  const auto between = [&](double a, double b) { return a + (b - a) * random.uniform(); };
  const auto normal = [&](double size) {
    const double x = random.normal(), y = random.normal(), z = random.normal();
    return Vec3{{size * x, size * y, size * z}};
  };
  const int side = static_cast<int>(std::ceil(std::cbrt(r.count)));
  const double step = std::cbrt(r.room * r.count) / side;
  for (int k = 0; k < r.count; ++k) {
    const Vec3 site{{k % side + 0.5, k / side % side + 0.5, k / side / side + 0.5}};
    const double radius = between(r.radius_min, r.radius_max);
    add_sphere(s.packing, radius, step * site + normal(0.05 * step), normal(r.speed), normal(r.spin));
  }
  if (r.cell) {
    s.packing.cell = PeriodicCell<3>{{{side * step, side * step, side * step}}};
    s.cell_motion.reference_length = s.packing.cell->length;
  }
  s.law = r.law, s.time_step = r.time_step;
  return s;
}

double total_mass(const State<Spheres>& s) {
  double mass = 0;
  for (const double m : s.packing.bodies.mass) mass += m;
  return mass;
}

}  // namespace isostat::oracle
