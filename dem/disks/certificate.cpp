#include "dem/disks/certificate.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "dem/disks/at_rest.hpp"
#include "dem/state/balance.hpp"

namespace isostat {
namespace {

// Mean kinetic energy per grain, and how many grains have more than `tolerance` each [F0 a].
struct Motion {
  double kinetic_energy = 0;
  std::int64_t moving = 0;
};
Motion motion_of(const Packing<2>& packing, const std::vector<BodyLoad>& loads, const DiskLaw& law, double tolerance) {
  const Bodies<2>& bodies = packing.bodies;
  const bool any_touching = std::any_of(loads.begin(), loads.end(), [](const BodyLoad& b) { return b.links > 0; });
  const bool all_count = law.attraction > 0 || !any_touching;
  Motion motion;
  std::size_t counted = 0;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    if (!is_free(packing.part, k) || (!all_count && loads[k].links == 0)) continue;
    double energy = 0.5 * bodies.mass[k] * dot(bodies.velocity[k], bodies.velocity[k]);
    if (law.friction > 0) energy += 0.5 * bodies.inertia[k] * bodies.spin[k] * bodies.spin[k];
    ++counted;
    motion.kinetic_energy += energy;
    motion.moving += !(energy <= tolerance);
  }
  if (counted > 0) motion.kinetic_energy /= static_cast<double>(counted);
  return motion;
}

}  // namespace

double force_scale(const DiskLaw& law, const ImposedStress<2>& imposed, double heaviest_weight) {
  const double scale = std::max({law.attraction, std::abs(largest_stress(imposed).value_or(0.0)),
                                 std::abs(imposed.shear.value_or(0.0)), heaviest_weight});
  return scale > 0 ? scale : 1.0;
}

double heaviest_weight(const Packing<2>& packing, double gravity) {
  double heaviest = 0;  // [m]
  for (std::size_t k = 0; k < packing.bodies.size(); ++k)
    if (is_free(packing.part, k)) heaviest = std::max(heaviest, packing.bodies.mass[k]);
  return heaviest * gravity;
}

Certificate evaluate_certificate(const Packing<2>& packing, const DiskLaw& law, const ImposedStress<2>& imposed,
                                 const EquilibriumScene& tolerance, double gravity) {
  Certificate c;
  c.force_scale = force_scale(law, imposed, heaviest_weight(packing, gravity));
  c.tolerance_force = tolerance.force;
  c.tolerance_pressure = tolerance.pressure;
  c.tolerance_kinetic = tolerance.kinetic_energy;
  c.pressure_controlled = largest_stress(imposed).has_value() && packing.cell.has_value();

  for (const Link<2>& link : packing.links) {
    if (!is_contact(link.kind)) continue;
    const YieldMargin m = yield_margin(law, link.gap, link.tangential_force, link.moment);
    c.sliding += m.sliding <= kYieldTolerance;
    c.rolling_yielded += m.rolling <= kYieldTolerance;
    c.smallest_margin = std::min({c.smallest_margin, m.sliding, m.rolling});
  }

  const std::vector<BodyLoad> loads = net_loads(packing);
  double largest_force = 0, largest_moment = 0;
  for (std::size_t k = 0; k < loads.size(); ++k) {
    if (!is_free(packing.part, k)) continue;
    const BodyLoad& b = loads[k];
    largest_force = largest_of(largest_force, std::hypot(b.fx, b.fy - packing.bodies.mass[k] * gravity));
    largest_moment = largest_of(largest_moment, std::abs(b.moment));
  }
  c.max_force = largest_force / c.force_scale;
  c.max_moment = largest_moment / c.force_scale;
  const Motion motion = motion_of(packing, loads, law, tolerance.kinetic_energy * c.force_scale);
  c.kinetic_energy_per_grain = motion.kinetic_energy / c.force_scale, c.moving = motion.moving;
  if (c.pressure_controlled) {
    StressTensor stress;
    add_virial(stress, packing);
    add_kinetic(stress, packing.bodies);
    const double area = packing.cell->measure();
    if (imposed[0]) c.pressure_error = std::abs(stress.xx / area - *imposed[0]) / c.force_scale;
    if (imposed[1])
      c.pressure_error = largest_of(c.pressure_error, std::abs(stress.yy / area - *imposed[1]) / c.force_scale);
    if (imposed.shear)
      c.pressure_error = largest_of(c.pressure_error, std::abs(stress.xy / area - *imposed.shear) / c.force_scale);
  }
  c.equilibrated = worst_criterion(c).ratio < 1;
  return c;
}

std::size_t loaded_contacts(const State<Disks>& s) {
  return static_cast<std::size_t>(std::count_if(s.packing.links.begin(), s.packing.links.end(), [&s](const Link<2>& l) {
    return is_contact(l.kind) && (s.law.attraction > 0 || l.normal_force > kLoadTolerance * s.certificate.force_scale);
  }));
}

Certificate evaluate_certificate(const State<Disks>& state) {
  Certificate c = evaluate_certificate(state.packing, state.law, state.imposed_stress, state.scene.equilibrium,
                                       state.scene.gravity);
  keep_record(c, state.certificate);
  c.moving = std::max(c.moving, state.certificate.moving);  // a static solve knows of slower ones
  return c;
}

}  // namespace isostat
