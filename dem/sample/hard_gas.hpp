// Positions denser than random sequential placement reaches: those of a gas of hard disks in a periodic cell. Shrunken
// disks, placed at random, are moved by the Monte Carlo method of Metropolis et al. (1953), a trial being taken if
// nothing then overlaps, while all of them grow by one factor; then they are moved on at full size. Valid below the
// solid fraction at which equal disks order, 0.70: there the result is the uniform gas in equilibrium.
#pragma once
#include <cstddef>
#include <vector>

#include "dem/sample/random_placement.hpp"
#include "dem/solver/random.hpp"
#include "dem/state/packing.hpp"

namespace isostat {

struct HardGas {
  PeriodicCell<2> cell;
  double gap = 0;            // [a] left between surfaces at least
  double move = 0.1;         // [mean diameter] a trial moves each coordinate by at most so much
  int sweeps = 500;          // at full size, each a trial for every disk
  int most_growth = 100000;  // [sweeps] give up then: with such a gap there is no room
};

// On entry no two of `bodies` overlap, and `placement` holds all of them; they grow to these radii. False: they
// did not get there.
bool grow_and_mix(const HardGas& gas, const std::vector<double>& radii, Placement<2>& placement, Bodies<2>& bodies,
                  Random& random);

}  // namespace isostat
