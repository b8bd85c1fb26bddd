// `lab throughput`: how fast the step loop runs on a fixed packing.
#pragma once
#include <cstdint>
#include <string_view>

#include "dem/disks/engine.hpp"
#include "dem/state/packing.hpp"

namespace isostat::lab {

struct ThroughputSetup {
  std::int64_t steps = 0;  // 0: about two seconds' worth
  int threads = 1;
  bool friction = true, rolling = true, cohesion = false, free_cell = false;
};

struct Throughput {
  double grain_steps_per_cpu_second = 0;  // CPU time of stepping only
  double grain_steps_per_wall_second = 0;
  std::int64_t grains = 0, steps = 0;
  double cpu_seconds = 0, wall_seconds = 0;
  double pairs_per_grain = 0;  // in the inner list
  StepTimes times;
  std::string_view isa;
};

// K_N = K_T = 1e5, mu .5, zeta .8, cell fixed or, with free_cell, held by the barostat at the stress it has.
Throughput measure_throughput(Packing<2> packing, const ThroughputSetup& setup);

}  // namespace isostat::lab
