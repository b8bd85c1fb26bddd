// `lab throughput`: how fast the step loop runs on a fixed packing.
#pragma once
#include <cstdint>

#include "dem/disks/engine.hpp"
#include "dem/solver/throughput.hpp"
#include "dem/state/packing.hpp"

namespace isostat::lab {

struct ThroughputSetup {
  std::int64_t steps = 0;  // 0: about two seconds' worth
  int threads = 1;
  bool friction = true, rolling = true, cohesion = false, free_cell = false;
};

// K_N = K_T = 1e5, mu .5, zeta .8, cell fixed or, with free_cell, held by the barostat at the stress it has.
Throughput measure_throughput(Packing<2> packing, const ThroughputSetup& setup);

}  // namespace isostat::lab
