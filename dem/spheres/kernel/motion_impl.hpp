// Motion of spheres (dem/spheres/motion.hpp), compiled for every instruction set: of elementwise operations alone, so
// with the same bits on all. Included only by the translation units dem/spheres/kernel/kernels_*.cpp.
#pragma once
#include "dem/spheres/kernel/row.hpp"
#include "dem/spheres/motion.hpp"

namespace isostat::spheres {
namespace {

// Triples in a vector of four, the last of which is nobody's: rows are written front to back, so that each triple
// overwrites what the one before it left in its first place.
using Quad __attribute__((vector_size(32))) = double;
using UnalignedQuad __attribute__((vector_size(32), aligned(8), may_alias)) = double;

Quad quad_at(const double* p) { return *reinterpret_cast<const UnalignedQuad*>(p); }
void put(double* p, Quad q) { *reinterpret_cast<UnalignedQuad*>(p) = q; }
Quad quad(const std::array<double, 3>& a) { return Quad{a[0], a[1], a[2], 0}; }

template <bool kRotation, bool kFreeCell, bool kMoments, bool kShear = false>
SphereMotionTally advance(const SphereArrays& bodies, std::size_t begin, std::size_t end, const MotionStep<3>& step,
                          double prediction, double gravity) {
  const double dt = step.time_step, ahead = prediction * dt;
  const Quad keep = quad(step.keep), scale = quad(step.scale);
  const Quad drift = dt * quad(step.half_scale), zero = {0, 0, 0, 0};
  Quad fastest = zero, kinetic = zero;
  [[maybe_unused]] double shear_kinetic = 0;
  double *row = bodies.rows + begin * kRowWidth, *load = bodies.loads + begin * kLoadWidth;
  double* spin = bodies.spins + begin * kSpinWidth;
  [[maybe_unused]] double* moment = bodies.moments + begin * kSpinWidth;
  for (std::size_t k = begin; k < end; ++k, row += kRowWidth, load += kLoadWidth, spin += kSpinWidth) {
    const SphereConstants& c = bodies.constants[k];
    const Quad acceleration = quad_at(load + LoadSlot::force) * c.inverse_mass;
    const Quad pushed = quad_at(row + Slot::half_velocity) + dt * acceleration;
    Quad velocity = pushed * keep;
    if constexpr (kShear) velocity[0] -= step.shear_coupling * pushed[1];
    const Quad predicted = velocity + ahead * acceleration;
    const Quad before = quad_at(row + Slot::position);
    Quad position;
    if constexpr (kFreeCell) {
      position = before * scale + velocity * drift;
      kinetic += c.mass * (predicted * predicted);
      if constexpr (kShear) {
        position[0] += step.shear * before[1] + dt * step.half_shear * velocity[1];
        shear_kinetic += c.mass * (predicted[0] * predicted[1]);
      }
    } else {
      position = before + dt * velocity;
    }
    put(row + Slot::position, position);
    put(row + Slot::velocity, predicted);
    put(row + Slot::half_velocity, velocity);
    if constexpr (kRotation) {
      Quad torque = c.radius * quad_at(load + LoadSlot::moment_per_radius);
      if constexpr (kMoments) {
        torque += quad_at(moment);
        put(moment, zero);
        moment += kSpinWidth;
      }
      const Quad turning = torque * c.inverse_inertia;
      const Quad w = (quad_at(spin) + dt * turning) * step.keep_spin;
      put(spin, w);
      put(row + Slot::half_surface, c.radius * w);
      put(row + Slot::surface, c.radius * (w + ahead * turning));
    }
    put(load + LoadSlot::force, Quad{0, 0, -(c.mass * gravity) + 0.0, 0});
    put(load + 4, zero);
    const Quad square = velocity * velocity;
    fastest = square > fastest ? square : fastest;
  }
  return {fastest[0] + fastest[1] + fastest[2], {kinetic[0], kinetic[1], kinetic[2]}, shear_kinetic};
}

template <bool kRotation, bool kMoments>
SphereMotionKernel in_cell(bool free) {
  return free ? advance<kRotation, true, kMoments> : advance<kRotation, false, kMoments>;
}
[[maybe_unused]] SphereMotionKernel motion_kernel(SphereMotionNeeds needs) {
  if (needs.shear) {
    if (!needs.rotation) return advance<false, true, false, true>;
    return needs.moments ? advance<true, true, true, true> : advance<true, true, false, true>;
  }
  if (!needs.rotation) return in_cell<false, false>(needs.free_cell);
  return needs.moments ? in_cell<true, true>(needs.free_cell) : in_cell<true, false>(needs.free_cell);
}

}  // namespace
}  // namespace isostat::spheres
