#include "dem/spheres/soft_contact.hpp"

#include <algorithm>
#include <cmath>

namespace isostat {

SoftContact soft_contact(const SoftParticleLaw& law, double modulus, double radius, double share) {
  const double stress = share * modulus * radius;  // [F0/a]
  SoftContact c;
  c.radius = radius;
  c.force = stress * radius * law.force, c.offset = stress * radius * law.offset, c.exponent = law.exponent;
  c.tangential = stress * law.tangential, c.tangential_exponent = law.tangential_exponent;
  c.threshold = law.offset < 0 ? std::pow(-law.offset / law.force, 1 / law.exponent) : 0.0;
  c.tangential_threshold = std::pow(c.threshold, c.tangential_exponent);
  return c;
}

SoftForce soft_force(const SoftContact& c, double overlap) {
  const double x = overlap / c.radius;
  if (!(x > c.threshold)) return {};
  const double slope = c.force * std::pow(x, c.exponent - 1);
  return {std::max(0.0, slope * x + c.offset), slope * c.exponent / c.radius};
}

double soft_tangential_stiffness(const SoftContact& c, double overlap) {
  const double x = overlap / c.radius;
  if (!(x > c.threshold)) return 0;
  return c.tangential * (std::pow(x, c.tangential_exponent) - c.tangential_threshold);
}

double soft_energy(const SoftContact& c, double overlap) {
  const double x = overlap / c.radius, more = c.exponent + 1;
  if (!(x > c.threshold)) return 0;
  return c.radius * (c.force / more * (std::pow(x, more) - std::pow(c.threshold, more)) + c.offset * (x - c.threshold));
}

}  // namespace isostat
