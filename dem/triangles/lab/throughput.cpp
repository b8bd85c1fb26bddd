#include "dem/triangles/lab/throughput.hpp"

#include <algorithm>

#include "dem/solver/clocks.hpp"
#include "dem/triangles/time_step.hpp"
#include "geometry/base/index.hpp"

namespace isostat::lab {
namespace {

constexpr double kDefaultTriangleSteps = 8e7, kWarmTriangleSteps = 2e6;
constexpr double kRoom = 1.15;  // of the circle about a grain, as scenes have it; a tight one is outgrown at once
constexpr std::int64_t kHeldTogether = 100, kLeastWarm = 10;  // steps

bool held_together(const TrianglePacking& p) {
  return p.cell ||
         std::any_of(p.grains.part.begin(), p.grains.part.end(), [](GrainPart q) { return q != GrainPart::free; });
}

}  // namespace

void make_network_run(State<TriangleGrains>& state) {
  state.scene = default_scene(SceneSystem::triangles, 1);
  state.law.damping = state.scene.triangle_law.damping;
  state.time_step = triangle_time_step(state.scene, state.packing);
  for (double& r : state.packing.grains.radius) r *= kRoom;
  if (state.packing.cell) state.cell_motion.reference_length = state.packing.cell->length;
}

TriangleThroughput measure_throughput(const State<TriangleGrains>& state, const TriangleThroughputSetup& setup) {
  SolverOptions options;
  options.threads = setup.threads, options.isa = setup.isa;
  TriangleThroughput t;
  const Grains& grains = state.packing.grains;
  for (std::size_t g = 0; g < grains.size(); ++g)
    if (grains.part[g] == GrainPart::free) ++t.grains, t.triangles += grains.begin[g + 1] - grains.begin[g];
  const auto triangles = static_cast<double>(t.triangles);
  const std::int64_t steps =
      setup.steps > 0 ? setup.steps
                      : std::max<std::int64_t>(20, static_cast<std::int64_t>(kDefaultTriangleSteps / triangles));
  const bool held = held_together(state.packing);
  const std::int64_t round = held ? steps : std::min(steps, kHeldTogether);
  const std::int64_t warm =
      held ? std::max(kLeastWarm, static_cast<std::int64_t>(kWarmTriangleSteps / triangles)) : kLeastWarm;
  for (; t.steps < steps; t.steps += round) {
    Solver<TriangleGrains> solver(state, {}, options);
    solver.run(warm);
    const StepTimes before = solver.times();
    const std::size_t rebuilds = solver.engine().lists().inner_rebuilds();
    const double cpu = cpu_seconds(setup.threads), wall = wall_seconds();
    solver.run(round);
    t.cpu_seconds += cpu_seconds(setup.threads) - cpu, t.wall_seconds += wall_seconds() - wall;
    t.rebuilds += static_cast<std::int64_t>(solver.engine().lists().inner_rebuilds() - rebuilds);
    for (std::size_t k = 0; k < t.times.seconds.size(); ++k)
      t.times.seconds[k] += solver.times().seconds[k] - before.seconds[k];
    t.pairs_per_triangle = static_cast<double>(solver.engine().candidates().pairs()) / triangles;
  }
  const auto done = static_cast<double>(t.steps);
  t.triangle_steps_per_cpu_second = triangles * done / t.cpu_seconds;
  t.grain_steps_per_cpu_second = static_cast<double>(t.grains) * done / t.cpu_seconds;
  t.grain_steps_per_wall_second = static_cast<double>(t.grains) * done / t.wall_seconds;
  t.isa = name(setup.isa);
  return t;
}

}  // namespace isostat::lab
