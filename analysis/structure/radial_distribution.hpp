// Radial distribution function of spheres in a periodic cell: pairs of centres at a distance over their number in a
// random arrangement of the same density.
#pragma once
#include <vector>

#include "dem/state/packing.hpp"

namespace isostat {

struct RadialDistribution {
  std::vector<double> edges, g;  // of equal bins from 0
};

// Up to r_max <= half the shortest edge, so that a pair has one image in reach. O(grains x neighbours within r_max).
RadialDistribution radial_distribution(const Packing<3>& packing, double r_max, double bin);

}  // namespace isostat
