#include "dem/spheres/lab/throughput.hpp"

#include <algorithm>

#include "dem/spheres/sample.hpp"
#include "dem/spheres/time_step.hpp"

namespace isostat::lab {

Throughput measure_throughput(const State<Spheres>& state, const SphereThroughputSetup& setup) {
  SolverOptions options;
  options.threads = setup.threads;
  Solver<Spheres> solver(state, {}, options);
  return time_steps(solver, state.packing.bodies.size(), setup.steps, options);
}

Throughput measure_throughput(const Packing<3>& packing, const SphereThroughputSetup& setup) {
  State<Spheres> state;
  SphereLawScene law;
  law.modulus = 1e6, law.poisson = 0.3, law.damping = 0.3;
  law.friction = setup.friction ? 0.3 : 0.0, law.rolling = setup.rolling;
  state.law = resolve(law);
  static_cast<Packing<3>&>(state.packing) = packing;
  state.packing.links.clear();
  Bodies<3>& b = state.packing.bodies;
  constexpr double kDensity = 1;
  set_sphere_inertia(b, kDensity);
  const double smallest = *std::min_element(b.radius.begin(), b.radius.end());
  state.time_step = 0.1 * contact_time(state.law, smallest, kDensity);
  if (packing.cell) state.cell_motion.reference_length = packing.cell->length;
  return measure_throughput(state, setup);
}

}  // namespace isostat::lab
