#include "dem/state/certificate.hpp"

#include <cmath>

namespace isostat {

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
