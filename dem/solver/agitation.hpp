// Velocities drawn for a stage: Maxwell velocities without drift of the centre of mass, the rms of |v| as asked, spins
// zero. Of round bodies, whose memory holds half-step velocities and forces.
#pragma once
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "dem/solver/random.hpp"
#include "dem/state/state.hpp"

namespace isostat {

// V* [a/T0] of a scene. With cohesion sqrt(F0 D0 / m), at which the attraction of a contact brings two grains together.
// Without it a sqrt(P / m) (in space a sqrt(a P / m)), P of the first stage that imposes a stress: the energy of a
// grain is then that of lifting the load of its cross-section by its diameter. Without both a/T0.
template <class System>
double velocity_unit(const State<System>& s) {
  if (s.law.attraction > 0) return std::sqrt(s.law.attraction * s.law.attraction_range);
  for (const StageScene& stage : s.scene.stages)
    if (const auto p = largest_stress(imposed_stress<System::dimension>(stage)); p && *p != 0)
      return std::sqrt(std::abs(*p));
  return 1;
}

// The rms of |v| that a stage asks for [a/T0].
template <class System>
double drawn_speed(const State<System>& s, const StageScene& stage) {
  const double speed = stage.velocity * velocity_unit(s);
  return stage.velocity_of == VelocityOf::component ? std::sqrt(System::dimension) * speed : speed;
}

template <class System>
void draw_velocities(State<System>& s, double rms) {
  constexpr int D = System::dimension;
  Bodies<D>& b = s.packing.bodies;
  Random random(s.seed, s.random_counter);
  // Drawn in the order of the ids: storage order is the solver's business.
  std::vector<std::size_t> order(b.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t p, std::size_t q) { return b.id[p] < b.id[q]; });
  std::erase_if(order, [&](std::size_t k) { return !is_free(s.packing.part, k); });
  const auto kinetic = [&b](std::size_t k) {
    double spinning;
    if constexpr (D == 2)
      spinning = b.inertia[k] * b.spin[k] * b.spin[k];
    else
      spinning = b.inertia[k] * dot(b.spin[k], b.spin[k]);
    return 0.5 * (b.mass[k] * dot(b.velocity[k], b.velocity[k]) + spinning);
  };
  double before = 0;
  for (std::size_t k = 0; k < b.size(); ++k)
    if (is_free(s.packing.part, k)) before += kinetic(k);
  Vec<D> momentum{};
  double mass = 0;
  for (const std::size_t k : order) {
    for (int a = 0; a < D; ++a) b.velocity[k][a] = random.normal();
    momentum += b.mass[k] * b.velocity[k];
    mass += b.mass[k];
  }
  double sum = 0;
  for (const std::size_t k : order) {
    b.velocity[k] -= (1 / mass) * momentum;
    sum += dot(b.velocity[k], b.velocity[k]);
  }
  const double scale = sum > 0 ? rms / std::sqrt(sum / static_cast<double>(order.size())) : 0.0;
  double after = 0;
  for (std::size_t k = 0; k < b.size(); ++k) {
    if (!is_free(s.packing.part, k)) continue;
    b.velocity[k] = scale * b.velocity[k];
    after += 0.5 * b.mass[k] * dot(b.velocity[k], b.velocity[k]);
    b.spin[k] = {};
    if (!s.memory.half_velocity.empty()) {
      s.memory.half_velocity[k] = b.velocity[k] - (0.5 * s.time_step / b.mass[k]) * s.memory.force[k];
      s.memory.half_spin[k] = -0.5 * s.time_step * s.memory.torque[k] / b.inertia[k];
    }
  }
  s.random_counter = random.counter();
  s.ledger.injected += after - before;
}

}  // namespace isostat
