#include "dem/sample/size_distribution.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace isostat {
namespace {

// With y = ln(r / r_min) in [0, L] the law is e^(s y), s = 1 - b: no case b = 1 but the limit s -> 0, and no overflow.

// ln of the integral of e^(s y) over [0, L].
double log_integral(double s, double l) {
  if (std::abs(s) * l < std::numeric_limits<double>::epsilon()) return std::log(l);
  return s > 0 ? s * l + std::log(-std::expm1(-s * l) / s) : std::log(std::expm1(s * l) / s);
}

}  // namespace

double SizeDistribution::quantile(double u) const {
  const double l = std::log(radius_max / radius_min), s = 1 - exponent;
  double y = u * l;
  if (std::abs(s) * l >= std::numeric_limits<double>::epsilon())
    y = s > 0 ? l + std::log1p((1 - u) * std::expm1(-s * l)) / s : std::log1p(u * std::expm1(s * l)) / s;
  return std::clamp(radius_min * std::exp(y), radius_min, radius_max);
}

double SizeDistribution::density(double r) const {
  const double y = std::log(r / radius_min), s = 1 - exponent;
  return std::exp(s * y - log_integral(s, std::log(radius_max / radius_min))) / r;
}

double SizeDistribution::moment(int k) const {
  const double l = std::log(radius_max / radius_min), s = 1 - exponent;
  if (!(l > 0)) return std::pow(radius_min, k);
  return std::pow(radius_min, k) * std::exp(log_integral(s + k, l) - log_integral(s, l));
}

}  // namespace isostat
