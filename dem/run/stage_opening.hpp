// What happens once when a stage begins, and how the cell is controlled in it.
#pragma once
#include <algorithm>
#include <numeric>
#include <vector>

#include "dem/run/loading.hpp"
#include "dem/run/outflow.hpp"
#include "dem/solver/barostat.hpp"
#include "dem/state/balance.hpp"
#include "dem/state/state.hpp"

namespace isostat {

// What a ramp begins with: the stress that was imposed along an edge, or else the one that is there, and its speed, as
// a rate of the edge as it is now.
template <class System>
void remember_imposed(State<System>& s) {
  for (int a = 0; a < System::dimension; ++a) {
    const auto& imposed = s.imposed_stress[static_cast<std::size_t>(a)];
    s.progress.ramp_stress[a] = imposed.value_or(s.progress.start_stress[a]);
    s.progress.ramp_rate[a] =
        s.packing.cell ? s.cell_motion.strain_rate[a] * s.cell_motion.reference_length[a] / s.packing.cell->length[a]
                       : 0;
  }
  s.progress.ramp_shear_stress = s.imposed_stress.shear.value_or(s.progress.start_shear_stress);
  s.progress.ramp_shear_rate =
      s.packing.cell ? -s.cell_motion.shear_strain_rate * s.cell_motion.reference_length[1] / s.packing.cell->length[1]
                     : 0;
}

// The system's own part comes first and last: the time step that the stage wants, the velocities it draws.
template <class System>
void open_stage(State<System>& s, const StageScene& stage) {
  prepare_stage(s, stage);
  if (stage.container.open && !s.surroundings.open) Outflow<System>::open(s);
  s.progress.started = true;
  s.progress.start_stress = static_stress(s);
  s.progress.start_shear_stress = static_shear_stress(s);
  s.progress.peak_stress = s.progress.carried_stress = 0;
  s.progress.carried_at = s.time;
  s.progress.drifting = false;
  s.progress.start_time = s.time;
  s.progress.drag_on = false;
  s.progress.quiet_since = s.progress.unchanged_since = s.time;
  remember_imposed(s);
  s.cell_motion.reference_length = s.packing.cell ? s.packing.cell->length : Vec<System::dimension>{};
  s.cell_motion.strain_rate = stage.ramp_time > 0 ? s.progress.ramp_rate : Vec<System::dimension>{};
  s.cell_motion.shear_strain_rate = s.cell_motion.shear_strain = 0;
  if (stage.ramp_time > 0 && s.packing.cell) s.cell_motion.shear_strain_rate = -s.progress.ramp_shear_rate;
  // Where no stage before has measured it, the first step goes by this.
  s.cell_motion.shear_stress = stage.stress_12 ? s.progress.start_shear_stress : 0;
  s.imposed_stress = imposed_stress<System::dimension>(stage);
  s.certificate.inertial_number = s.certificate.stress_error = kNotLookedAt;
  agitate(s, stage);
}

template <class System>
auto cell_control(const State<System>& s, const StageScene& stage) {
  CellControl<System::dimension> c;
  c.stress = imposed_stress<System::dimension>(stage);
  for (int a = 0; a < System::dimension; ++a)
    c.strain_rate[a] = stage.strain_rates()[static_cast<std::size_t>(a)].value_or(0);
  c.shear_rate = stage.shear_rate.value_or(0);
  c.max_strain_rate = stage.max_strain_rate;
  if (stage.max_edge_speed) c.max_edge_speed = *stage.max_edge_speed;
  // In the order of size: the storage order, which changes in the run, must not show in the last bit after a restart.
  std::vector<double> masses = s.packing.bodies.mass;
  std::sort(masses.begin(), masses.end());
  c.inertia = s.scene.cell.inertia * std::accumulate(masses.begin(), masses.end(), 0.0);
  c.rate_coupling = s.scene.cell.rate_coupling;
  c.damping = s.scene.cell.damping;
  c.ramp = {s.progress.start_time,        stage.ramp_time,           s.progress.ramp_stress, s.progress.ramp_rate,
            s.progress.ramp_shear_stress, s.progress.ramp_shear_rate};
  return c;
}

}  // namespace isostat
