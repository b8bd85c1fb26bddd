// Where the parts of a state that only spheres have lie in a state file (dem/files/state_layout.hpp).
#pragma once
#include <string>
#include <tuple>

#include "dem/files/round_layout.hpp"
#include "dem/spheres/spheres.hpp"

namespace isostat {

constexpr FileUnits file_units(Spheres) { return {"a", "T0"}; }

template <class Io>
void transfer_packing(Io& io, SpherePacking& packing) {
  static_assert(sizeof(SpherePacking) == sizeof(Packing<3>) + 3 * sizeof(std::vector<int>),
                "a new member needs its place here");
  auto& [cell, bodies, links, beams, part, feet] = static_cast<Packing<3>&>(packing);
  static_cast<void>(beams), static_cast<void>(part), static_cast<void>(feet);  // refused by state_fault(): of the plane
  transfer_round_bodies(io, cell, bodies);
  io.array(kGrainsGroup + "/group", packing.group, io.count(kGrainsGroup + "/group", packing.group.size()), "");
  transfer_round_links(io, links);
  const auto wall_members = [](SphereWall& wall) {
    auto& [shape, point, normal, wall_radius, wall_velocity, wall_group] = wall;
    return std::tie(shape, point, normal, wall_radius, wall_velocity, wall_group);
  };
  transfer_rows(
      io, "/walls", packing.walls, wall_members,
      {{"shape", ""}, {"point", "a"}, {"normal", ""}, {"radius", "a"}, {"velocity", "a T0-1"}, {"group", ""}});
  const auto link_members = [](WallLink& link) {
    auto& [body, wall, kind, gap, normal_force, tangential_force] = link;
    return std::tie(body, wall, kind, gap, normal_force, tangential_force);
  };
  transfer_rows(
      io, "/wall_links", packing.wall_links, link_members,
      {{"body", ""}, {"wall", ""}, {"kind", ""}, {"gap", "a"}, {"normal_force", "F0"}, {"tangential_force", "F0"}});
}

template <class Io>
void transfer_memory(Io& io, SphereMemory& memory) {
  auto& [half_velocity, half_spin, force, torque, pairs, wall_springs, lists] = memory;
  transfer_half_steps(io, half_velocity, half_spin, force, torque);
  transfer_springs(io, pairs);
  const auto wall_members = [](WallSpring& spring) {
    auto& [body, wall, tangential_force] = spring;
    return std::tie(body, wall, tangential_force);
  };
  transfer_rows(io, "/solver/walls", wall_springs, wall_members,
                {{"body", ""}, {"wall", ""}, {"tangential_force", "F0"}});
  transfer_lists(io, lists, "a");
}

template <class Io>
void transfer_law(Io& io, SphereLaw& law) {
  auto& [normal, grain, wall, normal_stiffness, tangential_stiffness, damping, tangential_damping, friction,
         wall_friction, rolling_friction, rolling_stiffness, attraction, attraction_range] = law;
  io.choice("/law", "normal", normal, kNormalForceNames);
  io.value("/law", "modulus", grain.modulus);
  io.value("/law", "poisson", grain.poisson);
  io.value("/law", "wall_modulus", wall.modulus);
  io.value("/law", "wall_poisson", wall.poisson);
  io.value("/law", "normal_stiffness", normal_stiffness);
  io.value("/law", "tangential_stiffness", tangential_stiffness);
  io.value("/law", "damping", damping);
  io.value("/law", "tangential_damping", tangential_damping);
  io.value("/law", "friction", friction);
  io.value("/law", "wall_friction", wall_friction);
  io.value("/law", "rolling_friction", rolling_friction);
  io.value("/law", "rolling_stiffness", rolling_stiffness);
  io.value("/law", "attraction", attraction);
  io.value("/law", "attraction_range", attraction_range);
}

}  // namespace isostat
