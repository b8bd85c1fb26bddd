#include "dem/state/certificate.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "dem/state/link_ends.hpp"

namespace isostat {
namespace {

struct BodyLoad {
  double fx = 0, fy = 0, moment = 0;
  int links = 0;
};

// max that keeps a NaN: a run that has blown up must never look balanced.
double largest_of(double a, double b) { return std::isnan(a) || b <= a ? a : b; }

// Sum over links of F_a r_b, not yet divided by the area.
void add_virial(StressTensor& s, const LinkFrame<double>& f, const LinkLoad<double>& load) {
  const double rx = f.nx * f.distance, ry = f.ny * f.distance;
  s.xx += load.fx * rx, s.xy += load.fx * ry;
  s.yx += load.fy * rx, s.yy += load.fy * ry;
}

void add_kinetic(StressTensor& s, const Bodies<2>& bodies) {
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const Vec2& v = bodies.velocity[k];
    s.xx += bodies.mass[k] * v[0] * v[0], s.xy += bodies.mass[k] * v[0] * v[1];
    s.yx += bodies.mass[k] * v[1] * v[0], s.yy += bodies.mass[k] * v[1] * v[1];
  }
}

// Mean kinetic energy per grain, and how many grains have more than `tolerance` each [F0 a].
struct Motion {
  double kinetic_energy = 0;
  std::int64_t moving = 0;
};
Motion motion_of(const Bodies<2>& bodies, const std::vector<BodyLoad>& loads, const LawParameters& law,
                 double tolerance) {
  const bool any_touching = std::any_of(loads.begin(), loads.end(), [](const BodyLoad& b) { return b.links > 0; });
  const bool all_count = law.attraction > 0 || !any_touching;
  Motion motion;
  std::size_t counted = 0;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    if (!all_count && loads[k].links == 0) continue;
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

double force_scale(const LawParameters& law, const ImposedStress& imposed) {
  const double scale = std::max(law.attraction, std::abs(largest_stress(imposed).value_or(0.0)));
  return scale > 0 ? scale : 1.0;
}

double static_normal_force(double gap, const LawParameters& law) {
  if (gap < 0) return contact_normal_force(gap, law);
  if (law.attraction > 0 && gap <= law.attraction_range) return distant_normal_force(gap, law);
  return 0;
}
double contact_normal_force(double gap, const LawParameters& law) {
  return -law.normal_stiffness * gap - law.attraction;
}
double distant_normal_force(double gap, const LawParameters& law) {
  return -law.attraction * (1 - gap / law.attraction_range);
}

YieldMargin yield_margin(double gap, double tangential_force, double moment, const LawParameters& law) {
  const double elastic = -law.normal_stiffness * gap;  // N_e
  const auto margin = [elastic](double coefficient, double force) {
    if (coefficient <= 0) return 1.0;  // the axis is absent
    return elastic > 0 ? 1 - std::abs(force) / (coefficient * elastic) : 0.0;
  };
  return {margin(law.friction, tangential_force), margin(law.rolling_friction, moment)};
}

LinkKind link_kind(double gap, double tangential_force, double moment, const LawParameters& law) {
  if (!(gap < 0)) return LinkKind::distant;
  const YieldMargin m = yield_margin(gap, tangential_force, moment, law);
  const bool slides = m.sliding <= kYieldTolerance, rolls = m.rolling <= kYieldTolerance;
  if (slides) return rolls ? LinkKind::both_yielded : LinkKind::sliding;
  return rolls ? LinkKind::rolling_yielded : LinkKind::closed;
}

StressTensor measured_stress(const Packing<2>& packing) {
  StressTensor s;
  add_kinetic(s, packing.bodies);
  for (const Link<2>& link : packing.links) {
    const LinkFrame<double> f = frame(ends(packing, link));
    add_virial(s, f, link_load(f, link.normal_force, link.tangential_force, link.moment));
  }
  const double area = packing.cell.value().measure();
  return {s.xx / area, s.xy / area, s.yx / area, s.yy / area};
}

Certificate evaluate_certificate(const Packing<2>& packing, const LawParameters& law, const ImposedStress& imposed,
                                 const EquilibriumScene& tolerance) {
  Certificate c;
  c.force_scale = force_scale(law, imposed);
  c.tolerance_force = tolerance.force;
  c.tolerance_pressure = tolerance.pressure;
  c.tolerance_kinetic = tolerance.kinetic_energy;
  c.pressure_controlled = largest_stress(imposed).has_value() && packing.cell.has_value();

  std::vector<BodyLoad> loads(packing.bodies.size());
  StressTensor stress;
  for (const Link<2>& link : packing.links) {
    const LinkFrame<double> f = frame(ends(packing, link));
    const LinkLoad<double> load = link_load(f, link.normal_force, link.tangential_force, link.moment);
    BodyLoad& on_i = loads[static_cast<std::size_t>(link.i)];
    BodyLoad& on_j = loads[static_cast<std::size_t>(link.j)];
    on_i.fx -= load.fx, on_i.fy -= load.fy, on_i.moment += load.moment_i, ++on_i.links;
    on_j.fx += load.fx, on_j.fy += load.fy, on_j.moment += load.moment_j, ++on_j.links;
    add_virial(stress, f, load);
    if (!is_contact(link.kind)) continue;
    const YieldMargin m = yield_margin(link.gap, link.tangential_force, link.moment, law);
    c.sliding += m.sliding <= kYieldTolerance;
    c.rolling_yielded += m.rolling <= kYieldTolerance;
    c.smallest_margin = std::min({c.smallest_margin, m.sliding, m.rolling});
  }

  double largest_force = 0, largest_moment = 0;
  for (const BodyLoad& b : loads) {
    largest_force = largest_of(largest_force, std::hypot(b.fx, b.fy));
    largest_moment = largest_of(largest_moment, std::abs(b.moment));
  }
  c.max_force = largest_force / c.force_scale;
  c.max_moment = largest_moment / c.force_scale;
  const Motion motion = motion_of(packing.bodies, loads, law, tolerance.kinetic_energy * c.force_scale);
  c.kinetic_energy_per_grain = motion.kinetic_energy / c.force_scale, c.moving = motion.moving;
  if (c.pressure_controlled) {
    add_kinetic(stress, packing.bodies);
    const double area = packing.cell->measure();
    if (imposed[0]) c.pressure_error = std::abs(stress.xx / area - *imposed[0]) / c.force_scale;
    if (imposed[1])
      c.pressure_error = largest_of(c.pressure_error, std::abs(stress.yy / area - *imposed[1]) / c.force_scale);
  }
  c.equilibrated = worst_criterion(c).ratio < 1;
  return c;
}

Certificate evaluate_certificate(const State& state) {
  Certificate c = evaluate_certificate(state.packing, state.law, state.imposed_stress, state.scene.equilibrium);
  c.finishing = state.certificate.finishing;
  c.moving = std::max(c.moving, state.certificate.moving);  // a static solve knows of slower ones
  return c;
}

WorstCriterion worst_criterion(const Certificate& c) {
  WorstCriterion worst{"force", 0};
  const auto consider = [&worst](const char* name, double value, double tolerance) {
    const double ratio = value / tolerance;
    if (!std::isnan(worst.ratio) && !(ratio <= worst.ratio)) worst = {name, ratio};  // a NaN is never met
  };
  consider("force", c.max_force, c.tolerance_force);
  consider("moment", c.max_moment, c.tolerance_force);
  if (c.pressure_controlled) consider("pressure", c.pressure_error, c.tolerance_pressure);
  consider("kinetic energy", c.kinetic_energy_per_grain, c.tolerance_kinetic);
  return worst;
}

}  // namespace isostat
