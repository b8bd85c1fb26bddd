#include "dem/disks/motion.hpp"

#include <algorithm>

namespace isostat {
namespace {

// A row is four pairs (x, y), (u, v), (R w, w), (p, q) and a load two; two lanes are in every 64-bit machine and
// nothing has to be moved between them.
using Pair __attribute__((vector_size(16), may_alias)) = double;

Pair* pairs(double* p) { return reinterpret_cast<Pair*>(__builtin_assume_aligned(p, 16)); }
Pair larger(Pair a, Pair b) { return a > b ? a : b; }

template <bool kRotation, bool kFreeCell, bool kWeight, bool kShear = false>
MotionTally advance(BodiesStore& bodies, std::size_t begin, std::size_t end, const MotionStep<2>& step,
                    double prediction, [[maybe_unused]] double gravity) {
  const double dt = step.time_step, ahead = prediction * dt;
  const Pair keep = {step.keep[0], step.keep[1]};
  const Pair scale = {step.scale[0], step.scale[1]}, drift = {dt * step.half_scale[0], dt * step.half_scale[1]};
  Pair fastest = {0, 0}, kinetic = {0, 0};
  [[maybe_unused]] double shear_kinetic = 0;
  double* row = bodies.row(begin);
  double* load = bodies.load(begin);
  for (std::size_t k = begin; k < end; ++k, row += kernel::kRowWidth, load += kernel::kLoadWidth) {
    const BodyConstants& c = bodies.constants[k];
    Pair* const r = pairs(row);
    Pair* const f = pairs(load);
    const Pair acceleration = f[0] * c.inverse_mass;
    Pair velocity = (r[1] + dt * acceleration) * keep;
    if constexpr (kShear) velocity[0] -= step.shear_coupling * (r[1][1] + dt * acceleration[1]);
    const Pair predicted = velocity + ahead * acceleration;
    if constexpr (kFreeCell) {
      [[maybe_unused]] const double height = r[0][1];
      r[0] = r[0] * scale + velocity * drift;
      kinetic += c.mass * (predicted * predicted);
      if constexpr (kShear) {
        r[0][0] += step.shear * height + dt * step.half_shear * velocity[1];
        shear_kinetic += c.mass * (predicted[0] * predicted[1]);
      }
    } else {
      r[0] += dt * velocity;
    }
    r[1] = velocity;
    if constexpr (kRotation) {
      const double moment = c.radius * f[1][0] + f[1][1];
      const double spin = (r[2][1] + dt * moment * c.inverse_inertia) * step.keep_spin;
      r[2] = Pair{c.radius * spin, spin};
    }
    r[3] = predicted;
    if constexpr (kWeight) {
      f[0] = Pair{0, -(c.mass * gravity)};
      f[1] = Pair{0, 0};
    } else {
      f[0] = f[1] = Pair{0, 0};
    }
    fastest = larger(fastest, velocity * velocity);
  }
  // max u^2 + max v^2 bounds max (u^2 + v^2)
  return {fastest[0] + fastest[1], {kinetic[0], kinetic[1]}, shear_kinetic};
}

template <bool kWeight>
MotionKernel with_weight(MotionNeeds needs) {
  if (needs.rotation) return needs.free_cell ? advance<true, true, kWeight> : advance<true, false, kWeight>;
  return needs.free_cell ? advance<false, true, kWeight> : advance<false, false, kWeight>;
}

}  // namespace

MotionKernel select_motion(MotionNeeds needs) {
  if (needs.shear) return needs.rotation ? advance<true, true, false, true> : advance<false, true, false, true>;
  return needs.weight ? with_weight<true>(needs) : with_weight<false>(needs);
}

}  // namespace isostat
