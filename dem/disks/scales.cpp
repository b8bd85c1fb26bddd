#include "dem/disks/scales.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dem/solver/agitation.hpp"

namespace isostat {

double time_step(const DiskLaw& law, double fraction, double heaviest) {
  return fraction * std::sqrt(heaviest / law.normal_stiffness);
}

double critical_time_step(const DiskLaw& law, double diameter, double mass) {
  const double translation = 6 * (law.normal_stiffness + law.tangential_stiffness) / mass;
  const double rotation = (24 * law.tangential_stiffness + 96 * law.rolling_stiffness / (diameter * diameter)) / mass;
  return 2 / std::sqrt(std::max(translation, rotation));
}

double critical_time_step(const DiskLaw& law, const Packing<2>& packing) {
  const Bodies<2>& b = packing.bodies;
  double least = INFINITY;
  for (std::size_t k = 0; k < b.size(); ++k)
    if (is_free(packing.part, k)) least = std::min(least, critical_time_step(law, 2 * b.radius[k], b.mass[k]));
  return least;
}

Scales scales(const DiskLaw& law, std::optional<double> pressure, double diameter_min, double time_step) {
  Scales s;
  s.force = std::max(law.attraction, std::abs(pressure.value_or(0)));
  if (s.force > 0) {
    s.kappa = law.normal_stiffness / s.force;
    s.time = 1 / std::sqrt(law.attraction > 0 ? law.attraction : s.force);
  }
  if (pressure) s.reduced_pressure = law.attraction > 0 ? *pressure / law.attraction : *pressure;
  if (law.attraction > 0) {
    s.overlap_over_range = law.attraction / (law.normal_stiffness * law.attraction_range);
    s.velocity = std::sqrt(law.attraction * law.attraction_range);
  }
  const double zeta = law.damping;
  s.restitution = zeta < 1 ? std::exp(-std::numbers::pi * zeta / std::sqrt(1 - zeta * zeta)) : 0.0;
  s.time_step = time_step;
  s.critical_time_step = critical_time_step(law, diameter_min);
  return s;
}

Scales scales(const State<Disks>& state) {
  Scales s = scales(state.law, largest_stress(state.imposed_stress), 1, state.time_step);
  if (const double bound = critical_time_step(state.law, state.packing); bound < INFINITY) s.critical_time_step = bound;
  if (!state.scene.stages.empty()) s.velocity = velocity_unit(state);
  return s;
}

SiScales si_scales(const UnitsScene& units) {
  SiScales si{};
  si.length = units.length;
  si.mass = units.density * std::numbers::pi * units.length * units.length / 4;
  si.force = units.force;
  si.time = std::sqrt(si.mass * si.length / si.force);
  return si;
}

}  // namespace isostat
