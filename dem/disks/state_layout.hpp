// Where the parts of a state that only disks have lie in a state file (dem/files/state_layout.hpp).
#pragma once
#include <string>
#include <tuple>

#include "dem/disks/disks.hpp"
#include "dem/files/state_columns.hpp"

namespace isostat {

constexpr FileUnits file_units(Disks) { return {"a", "T0"}; }

template <class Io>
void transfer_packing(Io& io, Packing<2>& packing) {
  auto& [cell, bodies, links, beams, part, feet] = packing;
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
  if (io.since(4)) transfer_codes(io, grains + "/part", part, io.count(grains + "/part", part.size()));
  if (io.since(5)) {
    const auto foot_members = [](Foot& foot) {
      auto& [wall, turning] = foot;
      return std::tie(wall, turning);
    };
    transfer_rows(io, "/feet", feet, foot_members, {{"wall", ""}, {"turning", "a-1"}});
  }

  const auto members = [](Link<2>& link) {
    auto& [i, j, shift, kind, beam, gap, normal_force, tangential_force, moment] = link;
    static_cast<void>(beam);
    return std::tie(i, j, shift, tangential_force, moment, kind, gap, normal_force);
  };
  transfer_rows(io, "/links", links, members,
                {{"i", ""},
                 {"j", ""},
                 {"shift", ""},
                 {"tangential_force", "F0"},
                 {"moment", "F0 a"},
                 {"kind", ""},
                 {"gap", "a"},
                 {"normal_force", "F0"}});
}

template <class Io>
void transfer_memory(Io& io, DiskMemory& memory) {
  auto& [half_velocity, half_spin, force, torque, pairs, lists, wall_position] = memory;
  transfer_memory_array(io, "half_velocity", half_velocity, "a T0-1");
  transfer_memory_array(io, "half_spin", half_spin, "T0-1");
  transfer_memory_array(io, "force", force, "F0");
  transfer_memory_array(io, "torque", torque, "F0 a");
  if (io.since(4)) transfer_memory_array(io, "wall_position", wall_position, "a");
  const auto members = [](PairMemory<DiskHistory>& pair) {
    auto& [i, j, shift, history] = pair;
    auto& [tangential_force, moment] = history;
    return std::tie(i, j, shift, tangential_force, moment);
  };
  transfer_rows(io, "/solver/pairs", pairs, members,
                {{"i", ""}, {"j", ""}, {"shift", ""}, {"tangential_force", "F0"}, {"moment", "F0 a"}});
  transfer_lists(io, lists, "a");
}

template <class Io>
void transfer_law(Io& io, DiskLaw& law) {
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

}  // namespace isostat
