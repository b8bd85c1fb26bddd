#include "dem/run/stage_opening.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "dem/disks/sample.hpp"
#include "dem/solver/random.hpp"
#include "dem/state/balance.hpp"
#include "dem/state/energy.hpp"

namespace isostat {
namespace {

// Maxwell velocities with the drift of the centre of mass removed and the rms of |v| equal to V0; spins zero.
void agitate(State& s, double rms) {
  Bodies<2>& b = s.packing.bodies;
  Random random(s.seed, s.random_counter);
  // Drawn in the order of the ids: storage order is the solver's business.
  std::vector<std::size_t> order(b.size());
  for (std::size_t k = 0; k < b.size(); ++k) order[k] = k;
  std::sort(order.begin(), order.end(), [&](std::size_t p, std::size_t q) { return b.id[p] < b.id[q]; });
  const double before = energies(s).kinetic;
  Vec2 momentum{};
  double mass = 0;
  for (std::size_t k : order) {
    b.velocity[k] = {{random.normal(), random.normal()}};
    momentum += b.mass[k] * b.velocity[k];
    mass += b.mass[k];
  }
  double sum = 0;
  for (std::size_t k : order) {
    b.velocity[k] -= (1 / mass) * momentum;
    sum += dot(b.velocity[k], b.velocity[k]);
  }
  const double scale = sum > 0 ? rms / std::sqrt(sum / static_cast<double>(b.size())) : 0.0;
  double after = 0;
  for (std::size_t k = 0; k < b.size(); ++k) {
    b.velocity[k] = scale * b.velocity[k];
    after += 0.5 * b.mass[k] * dot(b.velocity[k], b.velocity[k]);
    b.spin[k] = 0;
    if (!s.memory.half_velocity.empty()) {
      s.memory.half_velocity[k] = b.velocity[k] - (0.5 * s.time_step / b.mass[k]) * s.memory.force[k];
      s.memory.half_spin[k] = -0.5 * s.time_step * s.memory.torque[k] / b.inertia[k];
    }
  }
  s.random_counter = random.counter();
  s.ledger.injected += after - before;
}

// The step of a stage in which K_N changes is right for the stiffest contacts. Half-step velocities are those at
// time - dt/2.
void set_time_step(State& s, const StageScene& stage) {
  const double stiffest = std::max(s.law.normal_stiffness, stage.normal_stiffness.value_or(0));
  const double dt = time_step(s.scene, stiffest, s.packing.bodies), earlier = 0.5 * (s.time_step - dt);
  if (dt == s.time_step) return;
  s.time_step = dt;
  SolverMemory& m = s.memory;
  const Bodies<2>& b = s.packing.bodies;
  for (std::size_t k = 0; k < m.half_velocity.size(); ++k) {
    m.half_velocity[k] += (earlier / b.mass[k]) * m.force[k];
    m.half_spin[k] += earlier * m.torque[k] / b.inertia[k];
  }
}

}  // namespace

Vec2 static_stress(const State& s) {
  const StressTensor stress = measured_stress(s.packing);
  return {{stress.xx, stress.yy}};
}

void open_stage(State& s, const StageScene& stage) {
  set_time_step(s, stage);
  s.progress.started = true;
  s.progress.start_stiffness = s.law.normal_stiffness;
  s.progress.start_stress = static_stress(s);
  s.progress.peak_stress = 0;
  s.progress.drifting = false;
  s.progress.start_time = s.time;
  s.progress.drag_on = false;
  s.progress.quiet_since = s.progress.unchanged_since = s.time;
  s.cell_motion.reference_length = s.packing.cell->length;
  s.cell_motion.strain_rate = {};
  s.imposed_stress = imposed_stress(stage);
  if (stage.velocity > 0) agitate(s, stage.velocity * std::sqrt(s.law.attraction * s.law.attraction_range));
}

CellControl cell_control(const State& s, const StageScene& stage) {
  CellControl c;
  c.stress = imposed_stress(stage);
  c.strain_rate = {{stage.strain_rate_1.value_or(0), stage.strain_rate_2.value_or(0)}};
  c.max_strain_rate = stage.max_strain_rate;
  // In the order of size: the storage order, which changes in the run, must not show in the last bit after a restart.
  std::vector<double> masses = s.packing.bodies.mass;
  std::sort(masses.begin(), masses.end());
  c.inertia = s.scene.cell.inertia * std::accumulate(masses.begin(), masses.end(), 0.0);
  c.rate_coupling = s.scene.cell.rate_coupling;
  return c;
}

}  // namespace isostat
