// What a sample of radii says about the law that it comes from, both bounds of the law being known.
#pragma once
#include <cstddef>
#include <vector>

#include "dem/sample/size_distribution.hpp"

namespace isostat {

// Maximum likelihood of the truncated power law: the exponent whose mean of ln r is the sample's, and 1/sqrt(n I), I
// the Fisher information, as its standard error. NaN without a sample or if r_min = r_max; +-infinity if all radii lie
// at one bound. Radii outside the bounds count as at the bound. O(n).
struct Exponent {
  double value = 0, error = 0;
};
Exponent likely_exponent(const std::vector<double>& radii, double radius_min, double radius_max);

// Bins of equal ratio between the bounds.
struct SizeHistogram {
  std::vector<double> edge;        // bins + 1
  std::vector<std::size_t> count;  // of radii; those outside the bounds are in the first and the last bin
  std::vector<double> density;     // [1/length] count / (n width), to compare with SizeDistribution::density()
  std::vector<double> middle;      // geometric mean of a bin's edges
};
SizeHistogram size_histogram(const std::vector<double>& radii, double radius_min, double radius_max, int bins);

// Eq. 1 of seed 000 fitted to the histogram: unweighted least squares of ln P = ln a - b ln r over the bins that hold
// radii. (The paper does not say how it fits; this is what fitting a power law to a plotted distribution does.) Empty
// bins are left out, which biases b downwards where bins are nearly empty: the likely exponent is the one to trust.
struct PowerFit {
  double exponent = 0, exponent_error = 0;  // b, standard error from the residuals; NaN below 3 bins that hold radii
  double prefactor = 0;                     // a [length^(b - 1)]
  std::size_t bins = 0;                     // used
};
PowerFit fit_power_law(const SizeHistogram& histogram);

}  // namespace isostat
