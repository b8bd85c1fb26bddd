#include "dem/spheres/certificate.hpp"

#include <algorithm>
#include <cmath>

#include "dem/spheres/at_rest.hpp"
#include "dem/spheres/walls.hpp"

namespace isostat {
namespace {

ContactStiffness stiffness_of(const SphereLaw& law, const SpherePacking& packing, const Link<3>& link) {
  return pair_stiffness(law, body_of(packing, link.i), body_of(packing, link.j));
}

double wall_margin(const SphereLaw& law, const SphereBody& body, const WallLink& link) {
  const double friction = wall_stiffness(law, body).friction;
  return yield_margin(friction, friction * link.normal_force, norm(link.tangential_force));
}

}  // namespace

std::vector<BodyLoad3> net_loads(const SpherePacking& packing) {
  std::vector<BodyLoad3> loads = net_loads(static_cast<const Packing<3>&>(packing));
  for (const WallLink& link : packing.wall_links) {
    const auto k = static_cast<std::size_t>(link.body);
    const WallFrame frame = wall_frame(packing.walls[static_cast<std::size_t>(link.wall)], packing.bodies.position[k]);
    BodyLoad3& on = loads[k];
    on.force += link.normal_force * frame.n + link.tangential_force;
    on.moment -= frame.distance * cross(frame.n, link.tangential_force);
    ++on.links;
  }
  return loads;
}

double force_scale(const SphereLaw& law, const ImposedStress<3>& imposed) {
  const double scale = std::max(
      {law.attraction, std::abs(largest_stress(imposed).value_or(0.0)), std::abs(imposed.shear.value_or(0.0))});
  return scale > 0 ? scale : 1.0;
}

Certificate evaluate_certificate(const SpherePacking& packing, const SphereLaw& law, const ImposedStress<3>& imposed,
                                 const EquilibriumScene& tolerance, double) {
  Certificate c;
  c.force_scale = force_scale(law, imposed);
  c.tolerance_force = tolerance.force;
  c.tolerance_pressure = tolerance.pressure;
  c.tolerance_kinetic = tolerance.kinetic_energy;
  c.pressure_controlled = largest_stress(imposed).has_value() && packing.cell.has_value();

  const auto count = [&c](const YieldMargin& m) {
    c.sliding += m.sliding <= kYieldTolerance;
    c.rolling_yielded += m.rolling <= kYieldTolerance;
    c.smallest_margin = std::min({c.smallest_margin, m.sliding, m.rolling});
  };
  for (const Link<3>& link : packing.links)
    if (is_contact(link.kind))
      count(yield_margin(law, stiffness_of(law, packing, link), link.gap, link.tangential_force, link.moment));
  for (const WallLink& link : packing.wall_links) count({wall_margin(law, body_of(packing, link.body), link), 1.0});

  const std::vector<BodyLoad3> loads = net_loads(packing);
  double largest_force = 0, largest_moment = 0, energy = 0;
  const bool any_touching = std::any_of(loads.begin(), loads.end(), [](const BodyLoad3& b) { return b.links > 0; });
  const bool all_count = law.attraction > 0 || !any_touching;
  const Bodies<3>& bodies = packing.bodies;
  std::size_t counted = 0;
  for (std::size_t k = 0; k < loads.size(); ++k) {
    largest_force = largest_of(largest_force, norm(loads[k].force));
    largest_moment = largest_of(largest_moment, norm(loads[k].moment));
    if (!all_count && loads[k].links == 0) continue;  // a grain that touches nothing keeps its spin for ever
    double own = 0.5 * bodies.mass[k] * dot(bodies.velocity[k], bodies.velocity[k]);
    if (law.friction > 0) own += 0.5 * bodies.inertia[k] * dot(bodies.spin[k], bodies.spin[k]);
    ++counted;
    energy += own;
    c.moving += !(own <= tolerance.kinetic_energy * c.force_scale);
  }
  c.max_force = largest_force / c.force_scale;
  c.max_moment = largest_moment / c.force_scale;
  c.kinetic_energy_per_grain = energy / static_cast<double>(std::max<std::size_t>(counted, 1)) / c.force_scale;
  if (c.pressure_controlled) {
    const StressTensor3 tensor = measured_stress(packing);
    const Vec3 stress = diagonal(tensor);
    for (std::size_t a = 0; a < 3; ++a)
      if (imposed[a])
        c.pressure_error = largest_of(c.pressure_error, std::abs(stress.c[a] - *imposed[a]) / c.force_scale);
    if (imposed.shear)
      c.pressure_error = largest_of(c.pressure_error, std::abs(shear_of(tensor) - *imposed.shear) / c.force_scale);
  }
  c.equilibrated = worst_criterion(c).ratio < 1;
  return c;
}

Certificate evaluate_certificate(const State<Spheres>& state) {
  Certificate c = evaluate_certificate(state.packing, state.law, state.imposed_stress, state.scene.equilibrium);
  keep_record(c, state.certificate);
  return c;
}

std::size_t loaded_contacts(const State<Spheres>& s) {
  return static_cast<std::size_t>(std::count_if(s.packing.links.begin(), s.packing.links.end(), [&s](const Link<3>& l) {
    return is_contact(l.kind) && (s.law.attraction > 0 || l.normal_force > kLoadTolerance * s.certificate.force_scale);
  }));
}

}  // namespace isostat
