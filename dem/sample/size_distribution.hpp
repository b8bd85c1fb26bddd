// Radii of a truncated power law N(r) ~ r^-b, r_min <= r <= r_max (seed 000, Eq. 1). b = 0 is the uniform law.
#pragma once
#include "dem/solver/random.hpp"

namespace isostat {

struct SizeDistribution {
  double radius_min = 0.05, radius_max = 0.5;  // one unit of length for both; 0 < radius_min <= radius_max
  double exponent = 3.5;                       // b, finite, of either sign

  // Inverse of the cumulative distribution: the radius below which a share u of all lies; u in [0, 1].
  double quantile(double u) const;
  double draw(Random& random) const { return quantile(random.uniform()); }

  double density(double r) const;  // [1/length] a r^-b of Eq. 1, its integral is 1
  double moment(int k) const;      // [length^k] mean of r^k
};

}  // namespace isostat
