// How fast a step loop runs: steps of a solver whose caches are warm and whose lists have settled, timed.
#pragma once
#include <algorithm>
#include <cstdint>
#include <string_view>

#include "dem/solver/clocks.hpp"
#include "dem/solver/solver.hpp"

namespace isostat::lab {

struct Throughput {
  double grain_steps_per_cpu_second = 0;  // CPU time of stepping only
  double grain_steps_per_wall_second = 0;
  std::int64_t grains = 0, steps = 0;
  double cpu_seconds = 0, wall_seconds = 0;
  double pairs_per_grain = 0;  // in the inner list
  StepTimes times;
  std::string_view isa;
};

// steps: 0 for about two seconds' worth.
template <class System>
Throughput time_steps(Solver<System>& solver, std::size_t grains, std::int64_t steps, const SolverOptions& options) {
  constexpr double kPilotGrainSteps = 4e6, kDefaultGrainSteps = 2e8;
  const auto n = static_cast<double>(grains);
  solver.run(std::max<std::int64_t>(10, static_cast<std::int64_t>(kPilotGrainSteps / n)));
  Throughput t;
  t.steps = steps > 0 ? steps : std::max<std::int64_t>(20, static_cast<std::int64_t>(kDefaultGrainSteps / n));
  const StepTimes before = solver.times();
  const double cpu = cpu_seconds(options.threads);
  const double wall = wall_seconds();
  solver.run(t.steps);
  t.cpu_seconds = cpu_seconds(options.threads) - cpu;
  t.wall_seconds = wall_seconds() - wall;
  t.grains = static_cast<std::int64_t>(grains);
  t.grain_steps_per_cpu_second = n * static_cast<double>(t.steps) / t.cpu_seconds;
  t.grain_steps_per_wall_second = n * static_cast<double>(t.steps) / t.wall_seconds;
  t.pairs_per_grain = static_cast<double>(solver.engine().lists().inner_pairs()) / n;
  t.times = solver.times();
  for (std::size_t k = 0; k < t.times.seconds.size(); ++k) t.times.seconds[k] -= before.seconds[k];
  t.isa = name(options.isa);
  return t;
}

}  // namespace isostat::lab
