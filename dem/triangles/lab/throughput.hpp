// `lab throughput` on grains of triangles: how fast the step loop runs on a resting packing.
#pragma once
#include <cstdint>
#include <string_view>

#include "dem/triangles/engine.hpp"

namespace isostat::lab {

struct TriangleThroughputSetup {
  std::int64_t steps = 0;  // 0: about two seconds' worth
  int threads = 1;
  Isa isa = best_isa();
};

struct TriangleThroughput {
  double triangle_steps_per_cpu_second = 0, grain_steps_per_cpu_second = 0;  // free ones; CPU time of stepping only
  double grain_steps_per_wall_second = 0;
  std::int64_t grains = 0, triangles = 0, steps = 0;  // free ones
  double cpu_seconds = 0, wall_seconds = 0;
  double pairs_per_triangle = 0;  // candidates
  std::int64_t rebuilds = 0;      // of candidates, while timed
  StepTimes times;
  std::string_view isa;
};

// The state of a network, whose law has no dampers, with those of Sec. 6.1, and a time step of the smallest grain.
void make_network_run(State<TriangleGrains>& state);

// The state marched on as it is. A packing that neither a cell nor walls hold together is taken back to where it was
// every hundred steps, before it has come apart.
TriangleThroughput measure_throughput(const State<TriangleGrains>& state, const TriangleThroughputSetup& setup);

}  // namespace isostat::lab
