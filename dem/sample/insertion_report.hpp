// What came of an insertion, in numbers.
#pragma once
#include "dem/sample/insertion.hpp"
#include "dem/sample/size_statistics.hpp"

namespace isostat {

struct InsertionReport {
  std::size_t grains = 0, listed = 0;  // soft-particles included
  double solid_fraction = 0, trials = 0;
  bool reached = true;  // the wanted solid fraction
  Exponent exponent;    // of the radii after growth, soft-particles left out, maximum likelihood
  SizeHistogram sizes;  // of the same
  PowerFit fit;         // of Eq. 1 to that histogram
};

template <int D>
InsertionReport insertion_report(const InsertedGrains<D>& grains, const InsertionScene& scene, int bins = 10) {
  std::vector<double> solid;
  for (std::size_t k = 0; k < grains.radius.size(); ++k)
    if (grains.soft.empty() || grains.soft[k] == 0) solid.push_back(grains.radius[k]);
  InsertionReport r{grains.radius.size(),
                    grains.work.listed,
                    grains.solid_fraction,
                    grains.trials,
                    grains.reached,
                    likely_exponent(solid, scene.radius_min, scene.radius_max),
                    size_histogram(solid, scene.radius_min, scene.radius_max, bins),
                    {}};
  r.fit = fit_power_law(r.sizes);
  return r;
}

}  // namespace isostat
