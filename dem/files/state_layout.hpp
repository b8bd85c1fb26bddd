// Format version 7 of a state file, described once: writing and reading both follow transfer(). Io is StateWriter or
// StateReader of dem/files/state_io.hpp. Structured bindings name every member, so that a new member of State does
// not compile until it has its place here. Raise kStateFormatVersion and extend docs/formats.md with any change;
// io.since() says whether a member is there in an older file.
#pragma once
#include <limits>
#include <string>

#include "dem/state/state.hpp"

namespace isostat {

template <class Io, int D>
void transfer_progress(Io& io, StageProgress<D>& progress) {
  auto& [stage, start_time, started, drag_on, quiet_since, contact_set, unchanged_since, start_stiffness, start_stress,
         start_shear_stress, ramp_stress, ramp_rate, ramp_shear_stress, ramp_shear_rate, carried_stress, carried_at,
         peak_stress, drifting, solves, unmet] = progress;
  io.value("/progress", "stage", stage);
  io.value("/progress", "start_time", start_time);
  io.value("/progress", "started", started);
  io.value("/progress", "drag_on", drag_on);
  io.value("/progress", "quiet_since", quiet_since);
  io.value("/progress", "contact_set", contact_set);
  io.value("/progress", "unchanged_since", unchanged_since);
  io.value("/progress", "start_stiffness", start_stiffness);
  io.value("/progress", "start_stress", start_stress);
  if (io.since(7)) io.value("/progress", "start_shear_stress", start_shear_stress);
  io.value("/progress", "peak_stress", peak_stress);
  io.value("/progress", "drifting", drifting);
  if (io.since(7)) {
    io.value("/progress", "ramp_stress", ramp_stress);
    io.value("/progress", "ramp_rate", ramp_rate);
    io.value("/progress", "ramp_shear_stress", ramp_shear_stress);
    io.value("/progress", "ramp_shear_rate", ramp_shear_rate);
    io.value("/progress", "carried_stress", carried_stress);
    io.value("/progress", "carried_at", carried_at);
  }
  io.count_if_any("/progress", "solves", solves);
  io.text_if_any("/progress", "unmet", unmet);
}

template <class Io>
void transfer_surroundings(Io& io, Surroundings& surroundings) {
  auto& [start_offset, start_angle, open, grains_left, mass_left, last_left] = surroundings;
  io.value("/surroundings", "start_offset", start_offset);
  io.value("/surroundings", "start_angle", start_angle);
  io.value("/surroundings", "open", open);
  io.value("/surroundings", "grains_left", grains_left);
  io.value("/surroundings", "mass_left", mass_left);
  io.value("/surroundings", "last_left", last_left);
}

template <class Io>
void transfer_ledger(Io& io, EnergyLedger& ledger) {
  auto& [viscous, sliding, rolling, drag, cell_work, injected, wall_work, viscous_due, cell_work_due, wall_work_due] =
      ledger;
  io.value("/ledger", "viscous", viscous);
  io.value("/ledger", "sliding", sliding);
  io.value("/ledger", "rolling", rolling);
  io.value("/ledger", "drag", drag);
  io.value("/ledger", "cell_work", cell_work);
  io.value("/ledger", "injected", injected);
  io.value("/ledger", "viscous_due", viscous_due);
  io.value("/ledger", "cell_work_due", cell_work_due);
  if (!io.since(5)) return;
  io.value("/ledger", "wall_work", wall_work);
  io.value("/ledger", "wall_work_due", wall_work_due);
}

template <class Io>
void transfer_certificate(Io& io, Certificate& certificate) {
  auto& [max_force, max_moment, pressure_error, kinetic_energy_per_grain, force_scale, tolerance_force,
         tolerance_pressure, tolerance_kinetic, sliding, rolling_yielded, smallest_margin, moving, inertial_number,
         stress_error, pressure_controlled, equilibrated, finishing] = certificate;
  io.value("/certificate", "max_force", max_force);
  io.value("/certificate", "max_moment", max_moment);
  io.value("/certificate", "pressure_error", pressure_error);
  io.value("/certificate", "kinetic_energy_per_grain", kinetic_energy_per_grain);
  io.value("/certificate", "force_scale", force_scale);
  io.value("/certificate", "tolerance_force", tolerance_force);
  io.value("/certificate", "tolerance_pressure", tolerance_pressure);
  io.value("/certificate", "tolerance_kinetic", tolerance_kinetic);
  io.value("/certificate", "sliding", sliding);
  io.value("/certificate", "rolling_yielded", rolling_yielded);
  io.value("/certificate", "smallest_margin", smallest_margin);
  io.value("/certificate", "moving", moving);
  io.value("/certificate", "pressure_controlled", pressure_controlled);
  io.value("/certificate", "equilibrated", equilibrated);
  io.value("/certificate", "finishing", finishing);
  if (!io.since(7)) {
    inertial_number = stress_error = std::numeric_limits<double>::quiet_NaN();
    return;
  }
  io.value("/certificate", "inertial_number", inertial_number);
  io.value("/certificate", "stress_error", stress_error);
}

template <class Io, class System>
void transfer(Io& io, State<System>& state) {
  auto& [packing, law, time, step, time_step, cell_motion, imposed_stress, memory, progress, surroundings, ledger,
         certificate, scene, seed, random_counter] = state;
  io.value("/run", "time", time);
  io.value("/run", "step", step);
  io.value("/run", "time_step", time_step);
  for (std::size_t a = 0; a < imposed_stress.size(); ++a)
    io.value("/run", "imposed_stress_" + std::to_string(a + 1), imposed_stress[a]);
  io.value("/run", "imposed_stress_12", imposed_stress.shear);
  io.value("/run", "seed", seed);
  io.value("/run", "random_counter", random_counter);
  transfer_packing(io, packing);
  transfer_law(io, law);
  auto& [reference_length, strain_rate, stress, shear_strain_rate, shear_stress, shear_strain] = cell_motion;
  io.value("/cell", "reference_length", reference_length);
  io.value("/cell", "strain_rate", strain_rate);
  io.value("/cell", "stress", stress);
  if (io.since(7)) {
    io.value("/cell", "shear_strain_rate", shear_strain_rate);
    io.value("/cell", "shear_stress", shear_stress);
    io.value("/cell", "shear_strain", shear_strain);
  }
  transfer_memory(io, memory);
  transfer_progress(io, progress);
  if (io.since(4)) transfer_surroundings(io, surroundings);
  transfer_ledger(io, ledger);
  transfer_certificate(io, certificate);
  io.scene("/scene", scene);
}

}  // namespace isostat
