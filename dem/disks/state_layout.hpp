// Where the parts of a state that only disks have lie in a state file (dem/files/state_layout.hpp).
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "dem/disks/disks.hpp"

namespace isostat {

// Links and pairs as columns.
struct PairTable {
  std::vector<std::int32_t> i, j;
  std::vector<std::array<std::int32_t, 2>> shift;
  std::vector<double> tangential_force, moment;
};
struct LinkTable {
  PairTable pair;
  std::vector<std::uint8_t> kind;
  std::vector<double> gap, normal_force;
};

inline DiskHistory springs_of(const Link<2>& l) { return {l.tangential_force, l.moment}; }
inline DiskHistory springs_of(const PairMemory<DiskHistory>& p) { return p.history; }
inline void set_springs(Link<2>& l, const DiskHistory& h) {
  l.tangential_force = h.tangential_force, l.moment = h.moment;
}
inline void set_springs(PairMemory<DiskHistory>& p, const DiskHistory& h) { p.history = h; }

template <class Pair>
PairTable pair_table(const std::vector<Pair>& pairs) {
  PairTable c;
  for (const Pair& p : pairs) {
    const DiskHistory springs = springs_of(p);
    c.i.push_back(p.i), c.j.push_back(p.j), c.shift.push_back({p.shift[0], p.shift[1]});
    c.tangential_force.push_back(springs.tangential_force), c.moment.push_back(springs.moment);
  }
  return c;
}

template <class Pair>
std::vector<Pair> pairs_from(const PairTable& c) {
  std::vector<Pair> pairs(c.i.size());
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    pairs[k].i = c.i[k], pairs[k].j = c.j[k], pairs[k].shift = {c.shift[k][0], c.shift[k][1]};
    set_springs(pairs[k], {c.tangential_force[k], c.moment[k]});
  }
  return pairs;
}

template <class Io>
void transfer_pairs(Io& io, const std::string& group, PairTable& c) {
  const std::size_t count = io.count(group + "/i", c.i.size());
  io.array(group + "/i", c.i, count, "");
  io.array(group + "/j", c.j, count, "");
  io.array(group + "/shift", c.shift, count, "");
  io.array(group + "/tangential_force", c.tangential_force, count, "F0");
  io.array(group + "/moment", c.moment, count, "F0 a");
}

template <class Io>
void transfer_packing(Io& io, Packing<2>& packing) {
  auto& [cell, bodies, links, beams, part] = packing;
  static_cast<void>(part);
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

  LinkTable c;
  if (io.writes) {
    c.pair = pair_table(links);
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
void transfer_memory(Io& io, DiskMemory& memory) {
  auto& [half_velocity, half_spin, force, torque, pairs, lists, wall_position] = memory;
  static_cast<void>(wall_position);
  auto& [outer_position, inner_position, outer_length, inner_length, outer_skin, inner_skin, outer_travel,
         inner_travel] = lists;
  const auto column = [&](const std::string& name, auto& values, const char* unit) {
    io.array("/solver/" + name, values, io.count("/solver/" + name, values.size()), unit);
  };
  column("half_velocity", half_velocity, "a T0-1");
  column("half_spin", half_spin, "T0-1");
  column("force", force, "F0");
  column("torque", torque, "F0 a");
  column("outer_position", outer_position, "a");
  column("inner_position", inner_position, "a");
  PairTable c;
  if (io.writes) c = pair_table(pairs);
  transfer_pairs(io, "/solver/pairs", c);
  if (!io.writes) pairs = pairs_from<PairMemory<DiskHistory>>(c);
  io.value("/solver", "outer_length", outer_length);
  io.value("/solver", "inner_length", inner_length);
  io.value("/solver", "outer_skin", outer_skin);
  io.value("/solver", "inner_skin", inner_skin);
  io.value("/solver", "outer_travel", outer_travel);
  io.value("/solver", "inner_travel", inner_travel);
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
