// Where states of round bodies, disks and spheres, lie in a state file alike (state_layout.hpp of each).
#pragma once
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "dem/files/state_columns.hpp"
#include "dem/state/packing.hpp"

namespace isostat {

inline const std::string kGrainsGroup = "/particles/grains";

template <class Io, int D>
void transfer_round_bodies(Io& io, std::optional<PeriodicCell<D>>& cell, Bodies<D>& bodies) {
  auto& [id, position, velocity, spin, radius, mass, inertia] = bodies;
  const std::size_t n = io.count(kGrainsGroup + "/id", id.size());
  io.box(kGrainsGroup + "/box", cell);
  io.array(kGrainsGroup + "/id", id, n, "");
  io.element(kGrainsGroup + "/position", position, n, "a");
  io.element(kGrainsGroup + "/velocity", velocity, n, "a T0-1");
  io.element(kGrainsGroup + "/spin", spin, n, "T0-1");
  io.array(kGrainsGroup + "/radius", radius, n, "a");
  io.array(kGrainsGroup + "/mass", mass, n, "m");
  io.array(kGrainsGroup + "/inertia", inertia, n, "m a+2");
}

template <class Io, int D>
void transfer_round_links(Io& io, std::vector<Link<D>>& links) {
  const auto members = [](Link<D>& link) {
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

template <class Io, int D>
void transfer_half_steps(Io& io, std::vector<Vec<D>>& half_velocity, std::vector<Spin<D>>& half_spin,
                         std::vector<Vec<D>>& force, std::vector<Spin<D>>& torque) {
  transfer_memory_array(io, "half_velocity", half_velocity, "a T0-1");
  transfer_memory_array(io, "half_spin", half_spin, "T0-1");
  transfer_memory_array(io, "force", force, "F0");
  transfer_memory_array(io, "torque", torque, "F0 a");
}

template <class Io, class History, int D>
void transfer_springs(Io& io, std::vector<PairMemory<History, D>>& pairs) {
  const auto members = [](PairMemory<History, D>& pair) {
    auto& [i, j, shift, history] = pair;
    auto& [tangential_force, moment] = history;
    return std::tie(i, j, shift, tangential_force, moment);
  };
  transfer_rows(io, "/solver/pairs", pairs, members,
                {{"i", ""}, {"j", ""}, {"shift", ""}, {"tangential_force", "F0"}, {"moment", "F0 a"}});
}

}  // namespace isostat
