// The solver's traffic with State: taking it in at the start, giving it out as a snapshot.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "dem/disks/at_rest.hpp"
#include "dem/run_error.hpp"
#include "dem/solver/solver.hpp"
#include "dem/state/link.hpp"

namespace isostat {

void Solver::load_bodies(const State& state) {
  const Bodies<2>& b = state.packing.bodies;
  const SolverMemory& m = state.memory;
  const bool resumed = !m.half_velocity.empty();
  bodies_.resize(b.size());
  smallest_diameter_ = smallest_mass_ = INFINITY;
  for (std::size_t k = 0; k < b.size(); ++k) {
    const Vec2 u = resumed ? m.half_velocity[k] : b.velocity[k];
    const double w = resumed ? m.half_spin[k] : b.spin[k];
    double* row = bodies_.row(k);
    row[0] = b.position[k][0], row[1] = b.position[k][1];
    row[2] = u[0], row[3] = u[1], row[4] = b.radius[k] * w, row[5] = w;
    row[6] = b.velocity[k][0], row[7] = b.velocity[k][1];
    bodies_.id[k] = b.id[k];
    bodies_.constants[k] = {1 / b.mass[k], 1 / b.inertia[k], b.radius[k], b.mass[k]};
    bodies_.inertia[k] = b.inertia[k];
    smallest_diameter_ = std::min(smallest_diameter_, 2 * b.radius[k]);
    smallest_mass_ = std::min(smallest_mass_, b.mass[k]);
    largest_diameter_ = std::max(largest_diameter_, 2 * b.radius[k]);
    if (resumed) {
      double* load = bodies_.load(k);
      load[0] = m.force[k][0], load[1] = m.force[k][1], load[3] = m.torque[k];
    }
  }
  if (resumed) {
    lists_.restore(bodies_, m);
    return;
  }
  std::vector<PairMemory> springs;
  for (const Link<2>& l : state.packing.links)
    if (is_contact(l.kind)) {
      const bool swap = l.i > l.j;
      springs.push_back({swap ? l.j : l.i, swap ? l.i : l.j, swap ? ImageShift<2>{-l.shift[0], -l.shift[1]} : l.shift,
                         l.tangential_force, swap ? -l.moment : l.moment});
    }
  try {
    lists_.build(bodies_, cell_, std::move(springs));
  } catch (const std::runtime_error& e) {
    throw RunError(step_, -1, e.what(), "use more grains (grains.count) or a larger cell (grains.solid_fraction)");
  }
}

void Solver::snapshot(State& s) const {
  const std::size_t n = bodies_.size();
  s.time = time_, s.step = step_, s.time_step = dt_;
  s.packing.cell = cell_;
  s.cell_motion = cell_motion_;
  s.ledger = ledger_;
  s.imposed_stress = control_.stress;
  s.law = law_;

  Bodies<2>& b = s.packing.bodies;
  b.resize(n);
  SolverMemory& m = s.memory;
  m.half_velocity.resize(n), m.half_spin.resize(n), m.force.resize(n), m.torque.resize(n);
  for (std::size_t k = 0; k < n; ++k) {
    const double *row = bodies_.row(k), *load = bodies_.load(k);
    const BodyConstants& c = bodies_.constants[k];
    const double torque = c.radius * load[2] + load[3], half = 0.5 * dt_;
    b.id[k] = bodies_.id[k];
    b.position[k] = bodies_.position(k);
    b.velocity[k] = {{row[2] + half * load[0] * c.inverse_mass, row[3] + half * load[1] * c.inverse_mass}};
    b.spin[k] = row[5] + half * torque * c.inverse_inertia;
    b.radius[k] = c.radius, b.mass[k] = c.mass, b.inertia[k] = bodies_.inertia[k];
    m.half_velocity[k] = {{row[2], row[3]}};
    m.half_spin[k] = row[5];
    m.force[k] = {{load[0], load[1]}};
    m.torque[k] = torque;
  }
  lists_.remember(m);

  s.packing.links.clear();
  lists_.for_each([&](std::int32_t i, std::int32_t j, std::uint8_t code, double tangential, double moment) {
    const auto a = static_cast<std::size_t>(i), c = static_cast<std::size_t>(j);
    const Vec2 r = b.position[c] + cell_.offset(image_shift(code)) - b.position[a];
    const LinkFrame<double> frame = link_frame(r[0], r[1], b.radius[a], b.radius[c]);
    const bool distant = frame.gap >= 0;
    if (distant && !(law_.attraction > 0 && frame.gap < law_.attraction_range)) return;
    Link<2> link;
    link.i = i, link.j = j, link.shift = image_shift(code), link.gap = frame.gap;
    link.normal_force = at_rest(law_, frame.gap).force;
    link.tangential_force = distant ? 0.0 : tangential;
    link.moment = distant ? 0.0 : moment;
    link.kind = kind_of(law_, frame.gap, link.tangential_force, link.moment);
    s.packing.links.push_back(link);
  });
}

}  // namespace isostat
