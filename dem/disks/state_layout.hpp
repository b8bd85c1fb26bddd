// Where the parts of a state that only disks have lie in a state file (dem/files/state_layout.hpp).
#pragma once
#include <string>
#include <tuple>

#include "dem/disks/disks.hpp"
#include "dem/files/round_layout.hpp"

namespace isostat {

constexpr FileUnits file_units(Disks) { return {"a", "T0"}; }

template <class Io>
void transfer_packing(Io& io, Packing<2>& packing) {
  auto& [cell, bodies, links, beams, part, feet] = packing;
  static_cast<void>(beams);  // refused by state_fault(): no run has them yet
  transfer_round_bodies(io, cell, bodies);
  if (io.since(4)) transfer_codes(io, kGrainsGroup + "/part", part, io.count(kGrainsGroup + "/part", part.size()));
  if (io.since(5)) {
    const auto foot_members = [](Foot& foot) {
      auto& [wall, turning] = foot;
      return std::tie(wall, turning);
    };
    transfer_rows(io, "/feet", feet, foot_members, {{"wall", ""}, {"turning", "a-1"}});
  }
  transfer_round_links(io, links);
}

template <class Io>
void transfer_memory(Io& io, DiskMemory& memory) {
  auto& [half_velocity, half_spin, force, torque, pairs, lists, wall_position, solve] = memory;
  transfer_half_steps(io, half_velocity, half_spin, force, torque);
  if (io.since(4)) transfer_memory_array(io, "wall_position", wall_position, "a");
  transfer_springs(io, pairs);
  transfer_lists(io, lists, "a");
  bool solving = !solve.numbers.empty();
  io.flag_if_any("/progress", "solving", solving);
  if (!solving) return;
  io.array("/solve/numbers", solve.numbers, io.count("/solve/numbers", solve.numbers.size()), "");
  io.array("/solve/indices", solve.indices, io.count("/solve/indices", solve.indices.size()), "");
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
