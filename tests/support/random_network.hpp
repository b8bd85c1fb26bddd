// Random contact networks for rigidity tests and benchmarks; contact lines need not touch, so any coordination can be
// had.
#pragma once
#include <cstdint>

#include "dem/state/packing.hpp"

namespace isostat {

struct RandomNetwork {
  int columns = 10, rows = 10;  // grains on a jittered triangular lattice
  double coordination = 3.2;    // mean number of links per grain, at most 6
  bool periodic = true;
  double jitter = 0.15;                                                    // of the lattice constant 1
  double distant = 0, sliding = 0, rolling_yielded = 0, both_yielded = 0;  // fractions of the links
  std::uint64_t seed = 1;
};
Packing<2> random_network(const RandomNetwork& options);

}  // namespace isostat
