// The energy ledger of disks: what forces dissipate and what the cell does, step by step.
#include <cmath>

#include "dem/disks/at_rest.hpp"
#include "dem/disks/engine.hpp"
#include "dem/disks/kernel/crossing.hpp"

namespace isostat {

using kernel::LoadSlot;
using kernel::Slot;

// Work of the forces that keep only a part of the velocity: the impulse of each times the mean of the velocities before
// and after, exactly what the kinetic energy loses. The part due to the rate of the cell is the cell's work.
void DiskEngine::brake_ledger(const MotionStep<2>& step, double rate) {
  const double drag = rate * dt_;
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    const double *row = bodies_.row(k), *load = bodies_.load(k);
    const BodyConstants& c = bodies_.constants[k];
    if (c.inverse_mass == 0) continue;  // the container moves as it does
    const auto free_at = [&](int a) { return row[Slot::half_vx + a] + dt_ * load[LoadSlot::fx + a] * c.inverse_mass; };
    for (int a = 0; a < 2; ++a) {
      const double before = row[Slot::half_vx + a], free = free_at(a), brake = 1 - step.keep[a];
      const double sheared = a == 0 ? step.shear_coupling * free_at(1) : 0.0;
      const double mean = 0.5 * (before + free * step.keep[a] - sheared);
      ledger_.drag += c.mass * drag * free * mean;
      ledger_.cell_work -= c.mass * (brake - drag) * free * mean;
      ledger_.cell_work -= c.mass * sheared * mean;
    }
    if (!rotates_) continue;
    const double before = row[Slot::half_spin];
    const double free =
        before + dt_ * (c.radius * load[LoadSlot::moment_per_radius] + load[LoadSlot::moment]) * c.inverse_inertia;
    ledger_.drag += drag * free * 0.5 * (before + free * step.keep_spin) / c.inverse_inertia;
  }
}

// Springs were stretched over the step that ends now. Viscous forces and the moving cell work as the trapezium rule
// says: half of a step's work before its instant, half after.
void DiskEngine::keep_books() {
  if (!energies_) return;
  ledger_.sliding += force_tally_.sliding;
  ledger_.rolling += force_tally_.rolling;
  for (int half = 0; half < 2; ++half) {
    if (half == 1) set_work_due();
    ledger_.viscous += ledger_.viscous_due, ledger_.cell_work += ledger_.cell_work_due;
    ledger_.wall_work += ledger_.wall_work_due;
  }
}

void DiskEngine::set_work_due() {
  ledger_.viscous_due = 0.5 * dt_ * viscous_power();
  ledger_.cell_work_due = -0.5 * dt_ * (force_tally_.virial[0] * flow_.now[0] + force_tally_.virial[1] * flow_.now[1]);
  ledger_.cell_work_due -= 0.5 * dt_ * force_tally_.shear_virial * flow_.shear_now;
  ledger_.wall_work_due = 0.5 * dt_ * wall_power();
}

// What the container does to the grains: its bodies and feet feel the opposite of what they exert. Weights, with which
// the loads of bodies begin, are none of it.
double DiskEngine::wall_power() const {
  if (!moves(container_motion_)) return 0;
  double power = 0;
  const auto add = [&](std::size_t k, double weight) {
    const double* load = bodies_.load(k);
    const Vec2 v = velocity_at(container_.now, bodies_.position(k));
    const double torque = bodies_.constants[k].radius * load[LoadSlot::moment_per_radius] + load[LoadSlot::moment];
    power -= load[LoadSlot::fx] * v[0] + (load[LoadSlot::fy] + weight) * v[1] + torque * container_.now.spin;
  };
  for (const DrivenBody& d : bodies_.driven) {
    const auto k = static_cast<std::size_t>(d.body);
    add(k, bodies_.constants[k].mass * gravity_);
  }
  for (std::size_t k = 0; k < walls_.size(); ++k) add(bodies_.foot(k), 0);
  return power;
}

// Of the viscous forces of this instant, with the mean of the velocities before and after it. The forces themselves
// were evaluated with predicted velocities, before the loads were known.
double DiskEngine::viscous_power() const {
  if (!(law_.damping > 0)) return 0;
  double power = 0;
  for_each_pair(*this, [&](const DiskPairs&, std::size_t, std::int32_t a, std::int32_t b, std::uint8_t shift) {
    const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
    const BodyConstants &ci = bodies_.constants[i], &cj = bodies_.constants[j];
    const Vec2 r = branch(a, b, shift, cell_);
    const PairFrame<double> frame = pair_frame(r[0], r[1], ci.radius + cj.radius);
    if (frame.gap >= 0) return;
    double receding = 0, predicted = 0, mean = 0;
    for (int k = 0; k < 2; ++k) {
      const double normal = k == 0 ? frame.nx : frame.ny,
                   affine = flow_.now[k] * r[k] + (k == 0 ? flow_.shear_now * r[1] : 0.0);
      const double *ri = bodies_.row(i), *rj = bodies_.row(j);
      const auto kicked = [&](const double* row, const double* load, const BodyConstants& c) {  // at the full step
        const double of_container = row[Slot::vx + k] - row[Slot::half_vx + k];
        return c.inverse_mass == 0 ? of_container : 0.5 * dt_ * load[k] * c.inverse_mass;
      };
      const double kick = kicked(rj, bodies_.load(j), cj) - kicked(ri, bodies_.load(i), ci);
      const double half = rj[Slot::half_vx + k] - ri[Slot::half_vx + k];
      receding += normal * (half + flow_.half[k] * r[k] + (k == 0 ? flow_.shear_half * r[1] : 0.0));
      predicted += normal * (rj[Slot::vx + k] - ri[Slot::vx + k] + affine);
      mean += normal * (half + kick + affine);
    }
    const double damping = law_.damping * std::sqrt(4 * law_.normal_stiffness / (ci.inverse_mass + cj.inverse_mass));
    using kernel::Scalar;
    const Scalar weight = kernel::crossing_weights(Scalar(frame.gap), Scalar(receding * dt_),
                                                   kernel::crossing_braking(law_, dt_), Scalar(damping))
                              .viscous;
    power += weight[0] * damping * predicted * mean;
  });
  return power;
}

double DiskEngine::elastic_energy() const {
  double energy = 0;
  for_each_pair(*this, [&](const DiskPairs& pairs, std::size_t k, std::int32_t i, std::int32_t j, std::uint8_t shift) {
    const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
    const double gap = norm(branch(i, j, shift, cell_)) - (bodies_.radius(a) + bodies_.radius(b));
    if (!(gap < 0)) return;
    const DiskHistory h = pairs.history(k);
    const SpringEnergy springs = spring_energy(law_, h.tangential_force, h.moment);
    energy += contact(law_, gap).elastic + springs.tangential + springs.rolling;
  });
  return energy;
}

}  // namespace isostat
