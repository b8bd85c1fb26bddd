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
  static_assert(sizeof(SpherePacking) == sizeof(Packing<3>) + 4 * sizeof(std::vector<int>),
                "a new member needs its place here");
  auto& [cell, bodies, links, beams, part, feet] = static_cast<Packing<3>&>(packing);
  static_cast<void>(beams), static_cast<void>(part), static_cast<void>(feet);  // refused by state_fault(): of the plane
  transfer_round_bodies(io, cell, bodies);
  io.array(kGrainsGroup + "/group", packing.group, io.count(kGrainsGroup + "/group", packing.group.size()), "");
  if (io.since(6))
    io.array(kGrainsGroup + "/kind", packing.kind, io.count(kGrainsGroup + "/kind", packing.kind.size()), "");
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
void transfer_soft_law(Io& io, const std::string& name, SoftParticleLaw& law) {
  auto& [force, exponent, offset, tangential, tangential_exponent, friction] = law;
  io.value("/law", name + "_force", force);
  io.value("/law", name + "_exponent", exponent);
  io.value("/law", name + "_offset", offset);
  io.value("/law", name + "_tangential", tangential);
  io.value("/law", name + "_tangential_exponent", tangential_exponent);
  io.value("/law", name + "_friction", friction);
}

template <class Io>
void transfer_law(Io& io, SphereLaw& law) {
  auto& [normal, grain, wall, second, soft_solid, soft_soft, soft_curvature, normal_stiffness, tangential_stiffness,
         damping, tangential_damping, friction, wall_friction, rolling_friction, rolling_stiffness, attraction,
         attraction_range] = law;
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
  if (!io.since(6)) return;
  io.value("/law", "second_modulus", second.modulus);
  io.value("/law", "second_poisson", second.poisson);
  transfer_soft_law(io, "soft_solid", soft_solid);
  transfer_soft_law(io, "soft_soft", soft_soft);
  io.value("/law", "soft_curvature", soft_curvature);
}

}  // namespace isostat
