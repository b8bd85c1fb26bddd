#include "dem/motion.hpp"

#include <algorithm>

namespace isostat {
namespace {

template <bool kRotation, bool kFreeCell>
MotionTally advance(BodiesStore& bodies, std::size_t begin, std::size_t end, const MotionStep& step) {
  const double dt = step.time_step, half = 0.5 * dt;
  MotionTally tally;
  for (std::size_t k = begin; k < end; ++k) {
    double* __restrict row = bodies.row(k);
    double* __restrict load = bodies.load(k);
    const BodyConstants& c = bodies.constants[k];
    const double ax = load[0] * c.inverse_mass, ay = load[1] * c.inverse_mass;
    const double u = (row[2] + dt * ax) * step.keep[0], v = (row[3] + dt * ay) * step.keep[1];
    const double p = u + half * ax, q = v + half * ay;
    row[2] = u, row[3] = v, row[6] = p, row[7] = q;
    if constexpr (kFreeCell) {
      row[0] = row[0] * step.scale[0] + dt * u * step.half_scale[0];
      row[1] = row[1] * step.scale[1] + dt * v * step.half_scale[1];
      tally.kinetic[0] += c.mass * p * p;
      tally.kinetic[1] += c.mass * q * q;
    } else {
      row[0] += dt * u, row[1] += dt * v;
    }
    if constexpr (kRotation) {
      const double moment = c.radius * load[2] + load[3];
      const double w = (row[5] + dt * moment * c.inverse_inertia) * step.keep_spin;
      row[5] = w, row[4] = c.radius * w;
    }
    load[0] = load[1] = load[2] = load[3] = 0;
    tally.largest_speed_squared = std::max(tally.largest_speed_squared, u * u + v * v);
  }
  return tally;
}

}  // namespace

MotionKernel select_motion(MotionNeeds needs) {
  if (needs.rotation) return needs.free_cell ? advance<true, true> : advance<true, false>;
  return needs.free_cell ? advance<false, true> : advance<false, false>;
}

}  // namespace isostat
