#include "dem/disks/lab/throughput.hpp"

#include <algorithm>

#include "dem/solver/clocks.hpp"

#include "dem/disks/sample.hpp"
#include "dem/state/balance.hpp"

namespace isostat::lab {
namespace {

constexpr double kPilotGrainSteps = 4e6, kDefaultGrainSteps = 2e8;

}  // namespace

Throughput measure_throughput(Packing<2> packing, const ThroughputSetup& setup) {
  State<Disks> state;
  state.scene.law.friction = setup.friction ? 0.5 : 0.0;
  state.scene.law.rolling = setup.friction && setup.rolling;
  state.scene.law.attraction = setup.cohesion ? 1.0 : 0.0;
  state.law = resolve(state.scene.law);
  state.packing = std::move(packing);
  state.packing.links.clear();
  set_disk_inertia(state.packing.bodies);
  state.time_step = time_step(state.scene, state.law.normal_stiffness, state.packing);
  if (state.packing.cell) state.cell_motion.reference_length = state.packing.cell->length;

  SolverOptions options;
  options.threads = setup.threads;
  CellControl<2> control;
  if (setup.free_cell) {
    State<Disks> probe = state;
    Solver(state, {}, options).snapshot(probe);
    const StressTensor stress = measured_stress(probe.packing);
    control.stress = isotropic<2>(0.5 * (stress.xx + stress.yy));
    control.max_strain_rate = 0.05;
    control.inertia = 0;
    for (double m : state.packing.bodies.mass) control.inertia += 0.3 * m;
  }
  Solver solver(state, control, options);
  const auto n = static_cast<double>(state.packing.bodies.size());
  solver.run(std::max<std::int64_t>(10, static_cast<std::int64_t>(kPilotGrainSteps / n)));  // warm caches, settle lists

  Throughput t;
  t.steps =
      setup.steps > 0 ? setup.steps : std::max<std::int64_t>(20, static_cast<std::int64_t>(kDefaultGrainSteps / n));
  const StepTimes before = solver.times();
  const double cpu = cpu_seconds(setup.threads);
  const double wall = wall_seconds();
  solver.run(t.steps);
  t.cpu_seconds = cpu_seconds(setup.threads) - cpu;
  t.wall_seconds = wall_seconds() - wall;
  t.grains = static_cast<std::int64_t>(state.packing.bodies.size());
  t.grain_steps_per_cpu_second = n * static_cast<double>(t.steps) / t.cpu_seconds;
  t.grain_steps_per_wall_second = n * static_cast<double>(t.steps) / t.wall_seconds;
  t.pairs_per_grain = static_cast<double>(solver.engine().lists().inner_pairs()) / n;
  t.times = solver.times();
  for (std::size_t k = 0; k < t.times.seconds.size(); ++k) t.times.seconds[k] -= before.seconds[k];
  t.isa = name(options.isa);
  return t;
}

}  // namespace isostat::lab
