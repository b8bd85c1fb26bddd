// What happens once when a stage begins, and how the cell is controlled in it.
#pragma once
#include <algorithm>
#include <numeric>
#include <vector>

#include "dem/run/outflow.hpp"
#include "dem/solver/barostat.hpp"
#include "dem/state/balance.hpp"
#include "dem/state/state.hpp"

namespace isostat {

// sigma_11, sigma_22(, sigma_33) of the static forces [F0/a]; 0 without a cell.
template <class System>
Vec<System::dimension> static_stress(const State<System>& s) {
  if (!s.packing.cell) return {};
  return diagonal(measured_stress(s));
}

// sigma_12 of the static forces [F0/a]; 0 without a cell.
template <class System>
double static_shear_stress(const State<System>& s) {
  return s.packing.cell ? shear_of(measured_stress(s)) : 0.0;
}

// The system's own part comes first and last: the time step that the stage wants, the velocities it draws.
template <class System>
void open_stage(State<System>& s, const StageScene& stage) {
  prepare_stage(s, stage);
  if (stage.container.open && !s.surroundings.open) Outflow<System>::open(s);
  s.progress.started = true;
  s.progress.start_stress = static_stress(s);
  s.progress.start_shear_stress = static_shear_stress(s);
  s.progress.peak_stress = 0;
  s.progress.drifting = false;
  s.progress.start_time = s.time;
  s.progress.drag_on = false;
  s.progress.quiet_since = s.progress.unchanged_since = s.time;
  s.cell_motion.reference_length = s.packing.cell ? s.packing.cell->length : Vec<System::dimension>{};
  s.cell_motion.strain_rate = {};
  s.cell_motion.shear_strain_rate = s.cell_motion.shear_strain = 0;
  // Where no stage before has measured it, the first step goes by this.
  s.cell_motion.shear_stress = stage.stress_12 ? s.progress.start_shear_stress : 0;
  s.imposed_stress = imposed_stress<System::dimension>(stage);
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
  return c;
}

}  // namespace isostat
