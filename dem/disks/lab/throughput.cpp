#include "dem/disks/lab/throughput.hpp"

#include "dem/disks/sample.hpp"
#include "dem/state/balance.hpp"

namespace isostat::lab {

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
  return time_steps(solver, state.packing.bodies.size(), setup.steps, options);
}

}  // namespace isostat::lab
