// The energy ledger of grains of triangles: what dampers, friction and drag dissipate, what cell and container do. All
// by the trapezium rule over the step, with the velocities of full steps.
#include <cmath>

#include "dem/triangles/engine.hpp"
#include "geometry/base/index.hpp"

namespace isostat {

using Store = GrainStore;

TriangleEngine::SlotMotion TriangleEngine::full_step_motion(std::size_t k) const {
  const auto& s = store_;
  const double h = integrator_ == Integrator::gear ? 0 : 0.5 * dt_;
  return {s[Store::ux][k] + h * s[Store::fx][k] * s[Store::inverse_mass][k],
          s[Store::uy][k] + h * (s[Store::fy][k] * s[Store::inverse_mass][k] - gravity_ * s[Store::heavy][k]),
          s[Store::uw][k] + h * s[Store::torque][k] * s[Store::inverse_inertia][k]};
}

// Of a leapfrog step: the impulse of what keeps only a part of the velocity, times the mean of the velocities before
// and after. The part due to the rate of the cell is the cell's work.
void TriangleEngine::brake_ledger(const MotionStep<2>& step) {
  if (step.keep[0] == 1 && step.keep[1] == 1) return;
  const auto& s = store_;
  const double drag = drag_ * dt_;
  for (std::size_t k = 0; k < s.free_slots(); ++k) {
    const double im = s[Store::inverse_mass][k], ij = s[Store::inverse_inertia][k];
    if (im == 0) continue;  // padding
    const double before[] = {s[Store::ux][k], s[Store::uy][k], s[Store::uw][k]};
    const double free[] = {before[0] + dt_ * s[Store::fx][k] * im,
                           before[1] + dt_ * (s[Store::fy][k] * im - gravity_ * s[Store::heavy][k]),
                           before[2] + dt_ * s[Store::torque][k] * ij};
    for (int a = 0; a < 2; ++a) {
      const double mean = 0.5 * (before[a] + free[a] * step.keep[a]), brake = 1 - step.keep[a];
      ledger_.drag += s[Store::mass][k] * drag * free[a] * mean;
      ledger_.cell_work -= s[Store::mass][k] * (brake - drag) * free[a] * mean;
    }
    ledger_.drag += drag * free[2] * 0.5 * (before[2] + free[2] * step.keep_spin) / ij;
  }
}

// Half a step's work of the drag, at the velocities of now: once before the step and once after it.
void TriangleEngine::add_gear_drag() {
  if (drag_ == 0) return;
  double twice = 0;
  for (std::size_t k = 0; k < store_.free_slots(); ++k) {
    if (store_[Store::inverse_mass][k] == 0) continue;
    const SlotMotion v = full_step_motion(k);
    twice += store_[Store::mass][k] * (v.vx * v.vx + v.vy * v.vy) + store_[Store::inertia][k] * v.spin * v.spin;
  }
  ledger_.drag += 0.5 * dt_ * drag_ * twice;
}

void TriangleEngine::add_works() {
  ledger_.sliding += overlap_tally_.slipped;
  if (integrator_ == Integrator::gear) add_gear_drag();
  for (int half = 0; half < 2; ++half) {
    if (half == 1) set_work_due();
    ledger_.viscous += ledger_.viscous_due, ledger_.cell_work += ledger_.cell_work_due;
    ledger_.wall_work += ledger_.wall_work_due;
  }
}

void TriangleEngine::set_work_due() {
  ledger_.viscous_due = 0.5 * dt_ * viscous_power();
  ledger_.cell_work_due = 0;
  for (int a = 0; a < 2; ++a)
    ledger_.cell_work_due -= 0.5 * dt_ * (overlap_tally_.virial[a] + beam_tally_.virial[a]) * flow_.now[a];
  ledger_.wall_work_due = 0.5 * dt_ * wall_power();
}

// Of the dampers: gamma on elongation, gamma I/L0 on bending, as in kernel/beam_force_impl.hpp.
double TriangleEngine::viscous_power() const {
  if (!(law_.damping > 0)) return 0;
  double power = 0;
  for (std::size_t g = 0; g < store_.grains(); ++g) {
    if (store_.driven(g)) continue;
    for (std::size_t b = 0; b < store_.beams(g); ++b) {
      const std::size_t i = store_.slot(g, store_.joined(g, b)[0]), j = store_.slot(g, store_.joined(g, b)[1]),
                        place = store_.beam_place(g, b);
      const double rx = store_[Store::x][j] - store_[Store::x][i], ry = store_[Store::y][j] - store_[Store::y][i];
      const double length = std::hypot(rx, ry), nx = rx / length, ny = ry / length;
      const SlotMotion vi = full_step_motion(i), vj = full_step_motion(j);
      const double vx = vj.vx - vi.vx + flow_.now[0] * rx, vy = vj.vy - vi.vy + flow_.now[1] * ry;
      const double receding = nx * vx + ny * vy, turning = vj.spin - vi.spin;
      const double shear = nx * vy - ny * vx - 0.5 * length * (vi.spin + vj.spin);
      const double gamma = store_.beam(Store::damping)[place], bending = store_.beam(Store::bending_damping)[place];
      power += gamma * receding * receding + 2 * bending / (length * length) * shear * shear +
               0.5 * bending * turning * turning;
    }
  }
  return power;
}

// What the container does to the grains: its triangles feel the opposite of what they exert.
double TriangleEngine::wall_power() const {
  if (!moves(motion_)) return 0;
  const ContainerPlacement at = container_at(motion_, surroundings_, time_ - stage_start_);
  double power = 0;
  for (std::size_t g = 0; g < store_.grains(); ++g) {
    if (!store_.driven(g)) continue;
    for (std::size_t t = 0; t < store_.triangles(g); ++t) {
      const std::size_t k = store_.slot(g, t);
      const Vec2 v = velocity_at(at, {{store_[Store::x][k], store_[Store::y][k]}});
      power -= store_[Store::fx][k] * v[0] + store_[Store::fy][k] * v[1] + store_[Store::torque][k] * at.spin;
    }
  }
  return power;
}

}  // namespace isostat
