// Format version 3 of a state file, described once: writing and reading both follow transfer(). Io is StateWriter or
// StateReader of dem/files/state_file.cpp. Structured bindings name every member, so that a new member of State does
// not compile until it has its place here. Raise kStateFormatVersion and extend docs/formats.md with any change.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "dem/state/state.hpp"

namespace isostat {

// Links and pairs as columns.
struct PairColumns {
  std::vector<std::int32_t> i, j;
  std::vector<std::array<std::int32_t, 2>> shift;
  std::vector<double> tangential_force, moment;
};
struct LinkColumns {
  PairColumns pair;
  std::vector<std::uint8_t> kind;
  std::vector<double> gap, normal_force;
};

template <class Pair>
PairColumns pair_columns(const std::vector<Pair>& pairs) {
  PairColumns c;
  for (const Pair& p : pairs) {
    c.i.push_back(p.i), c.j.push_back(p.j), c.shift.push_back({p.shift[0], p.shift[1]});
    c.tangential_force.push_back(p.tangential_force), c.moment.push_back(p.moment);
  }
  return c;
}

template <class Pair>
std::vector<Pair> pairs_from(const PairColumns& c) {
  std::vector<Pair> pairs(c.i.size());
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    pairs[k].i = c.i[k], pairs[k].j = c.j[k], pairs[k].shift = {c.shift[k][0], c.shift[k][1]};
    pairs[k].tangential_force = c.tangential_force[k], pairs[k].moment = c.moment[k];
  }
  return pairs;
}

template <class Io>
void transfer_pairs(Io& io, const std::string& group, PairColumns& c) {
  const std::size_t count = io.count(group + "/i", c.i.size());
  io.array(group + "/i", c.i, count, "");
  io.array(group + "/j", c.j, count, "");
  io.array(group + "/shift", c.shift, count, "");
  io.array(group + "/tangential_force", c.tangential_force, count, "F0");
  io.array(group + "/moment", c.moment, count, "F0 a");
}

template <class Io>
void transfer_packing(Io& io, Packing<2>& packing) {
  auto& [cell, bodies, links, beams] = packing;
  static_cast<void>(beams);  // refused by state_fault(): no run has them yet
  auto& [id, position, velocity, spin, radius, mass, inertia] = bodies;
  const std::string grains = "/particles/grains";
  const std::size_t n = io.count(grains + "/id", id.size());
  io.box(grains + "/box", cell);
  io.array(grains + "/id", id, n, "");
  io.element(grains + "/position", position, n, "a");
  io.element(grains + "/velocity", velocity, n, "a T0-1");
  io.element(grains + "/spin", spin, n, "T0-1");
  io.array(grains + "/radius", radius, n, "a");
  io.array(grains + "/mass", mass, n, "m");
  io.array(grains + "/inertia", inertia, n, "m a+2");

  LinkColumns c;
  if (io.writes) {
    c.pair = pair_columns(links);
    for (const Link<2>& l : links) {
      c.kind.push_back(static_cast<std::uint8_t>(l.kind));
      c.gap.push_back(l.gap), c.normal_force.push_back(l.normal_force);
    }
  }
  transfer_pairs(io, "/links", c.pair);
  const std::size_t m = c.pair.i.size();
  io.array("/links/kind", c.kind, m, "");
  io.array("/links/gap", c.gap, m, "a");
  io.array("/links/normal_force", c.normal_force, m, "F0");
  if (io.writes) return;
  links = pairs_from<Link<2>>(c.pair);
  for (std::size_t k = 0; k < m; ++k) {
    links[k].kind = static_cast<LinkKind>(c.kind[k]);
    links[k].gap = c.gap[k], links[k].normal_force = c.normal_force[k];
  }
}

template <class Io>
void transfer_memory(Io& io, SolverMemory& memory) {
  auto& [half_velocity, half_spin, force, torque, pairs, outer_position, inner_position, outer_length, inner_length,
         outer_skin, inner_skin, outer_travel, inner_travel] = memory;
  const auto column = [&](const std::string& name, auto& values, const char* unit) {
    io.array("/solver/" + name, values, io.count("/solver/" + name, values.size()), unit);
  };
  column("half_velocity", half_velocity, "a T0-1");
  column("half_spin", half_spin, "T0-1");
  column("force", force, "F0");
  column("torque", torque, "F0 a");
  column("outer_position", outer_position, "a");
  column("inner_position", inner_position, "a");
  PairColumns c;
  if (io.writes) c = pair_columns(pairs);
  transfer_pairs(io, "/solver/pairs", c);
  if (!io.writes) pairs = pairs_from<PairMemory>(c);
  io.value("/solver", "outer_length", outer_length);
  io.value("/solver", "inner_length", inner_length);
  io.value("/solver", "outer_skin", outer_skin);
  io.value("/solver", "inner_skin", inner_skin);
  io.value("/solver", "outer_travel", outer_travel);
  io.value("/solver", "inner_travel", inner_travel);
}

template <class Io>
void transfer_law(Io& io, LawParameters& law) {
  auto& [normal_stiffness, tangential_stiffness, damping, friction, rolling_friction, rolling_stiffness, attraction,
         attraction_range] = law;
  io.value("/law", "normal_stiffness", normal_stiffness);
  io.value("/law", "tangential_stiffness", tangential_stiffness);
  io.value("/law", "damping", damping);
  io.value("/law", "friction", friction);
  io.value("/law", "rolling_friction", rolling_friction);
  io.value("/law", "rolling_stiffness", rolling_stiffness);
  io.value("/law", "attraction", attraction);
  io.value("/law", "attraction_range", attraction_range);
}

template <class Io>
void transfer_progress(Io& io, StageProgress& progress) {
  auto& [stage, start_time, started, drag_on, quiet_since, contact_set, unchanged_since, start_stiffness, start_stress,
         peak_stress, drifting] = progress;
  io.value("/progress", "stage", stage);
  io.value("/progress", "start_time", start_time);
  io.value("/progress", "started", started);
  io.value("/progress", "drag_on", drag_on);
  io.value("/progress", "quiet_since", quiet_since);
  io.value("/progress", "contact_set", contact_set);
  io.value("/progress", "unchanged_since", unchanged_since);
  io.value("/progress", "start_stiffness", start_stiffness);
  io.value("/progress", "start_stress", start_stress);
  io.value("/progress", "peak_stress", peak_stress);
  io.value("/progress", "drifting", drifting);
}

template <class Io>
void transfer_ledger(Io& io, EnergyLedger& ledger) {
  auto& [viscous, sliding, rolling, drag, cell_work, injected, viscous_due, cell_work_due] = ledger;
  io.value("/ledger", "viscous", viscous);
  io.value("/ledger", "sliding", sliding);
  io.value("/ledger", "rolling", rolling);
  io.value("/ledger", "drag", drag);
  io.value("/ledger", "cell_work", cell_work);
  io.value("/ledger", "injected", injected);
  io.value("/ledger", "viscous_due", viscous_due);
  io.value("/ledger", "cell_work_due", cell_work_due);
}

template <class Io>
void transfer_certificate(Io& io, Certificate& certificate) {
  auto& [max_force, max_moment, pressure_error, kinetic_energy_per_grain, force_scale, tolerance_force,
         tolerance_pressure, tolerance_kinetic, sliding, rolling_yielded, smallest_margin, moving, pressure_controlled,
         equilibrated, finishing] = certificate;
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
}

template <class Io>
void transfer(Io& io, State& state) {
  auto& [packing, law, time, step, time_step, cell_motion, imposed_stress, memory, progress, ledger, certificate, scene,
         seed, random_counter] = state;
  io.value("/run", "time", time);
  io.value("/run", "step", step);
  io.value("/run", "time_step", time_step);
  io.value("/run", "imposed_stress_1", imposed_stress[0]);
  io.value("/run", "imposed_stress_2", imposed_stress[1]);
  io.value("/run", "seed", seed);
  io.value("/run", "random_counter", random_counter);
  transfer_packing(io, packing);
  transfer_law(io, law);
  auto& [reference_length, strain_rate, stress] = cell_motion;
  io.value("/cell", "reference_length", reference_length);
  io.value("/cell", "strain_rate", strain_rate);
  io.value("/cell", "stress", stress);
  transfer_memory(io, memory);
  transfer_progress(io, progress);
  transfer_ledger(io, ledger);
  transfer_certificate(io, certificate);
  io.scene("/scene", scene);
}

}  // namespace isostat
