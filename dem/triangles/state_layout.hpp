// Where the parts of a state that only grains of triangles have lie in a state file (dem/files/state_layout.hpp).
#pragma once
#include <string>
#include <tuple>
#include <vector>

#include "dem/files/state_columns.hpp"
#include "dem/triangles/triangles.hpp"

namespace isostat {

constexpr FileUnits file_units(TriangleGrains) { return {"cm", "s"}; }

template <class Io>
void transfer_grains(Io& io, Grains& grains) {
  auto& [id, begin, part, radius] = grains;
  const std::size_t n = io.count("/grains/id", id.size());
  io.array("/grains/id", id, n, "");
  io.array("/grains/begin", begin, io.count("/grains/begin", begin.size()), "");
  transfer_codes(io, "/grains/part", part, n);
  io.array("/grains/radius", radius, n, "cm");
}

template <class Io>
void transfer_beams(Io& io, std::vector<Link<2>>& links, std::vector<Beam>& beams) {
  const auto link_members = [](Link<2>& link) {
    auto& [i, j, shift, kind, beam, gap, normal_force, tangential_force, moment] = link;
    return std::tie(i, j, shift, kind, beam, gap, normal_force, tangential_force, moment);
  };
  transfer_rows(io, "/links", links, link_members,
                {{"i", ""},
                 {"j", ""},
                 {"shift", ""},
                 {"kind", ""},
                 {"beam", ""},
                 {"gap", "cm"},
                 {"normal_force", "dyn"},
                 {"tangential_force", "dyn"},
                 {"moment", "dyn cm"}});
  const auto beam_members = [](Beam& beam) {
    auto& [rest_length, rest_angle_i, rest_angle_j, stiffness, bending] = beam;
    return std::tie(rest_length, rest_angle_i, rest_angle_j, stiffness, bending);
  };
  transfer_rows(io, "/beams", beams, beam_members,
                {{"rest_length", "cm"},
                 {"rest_angle_i", "rad"},
                 {"rest_angle_j", "rad"},
                 {"stiffness", "g s-2"},
                 {"bending", "g cm+3 s-2"}});
}

template <class Io>
void transfer_overlaps(Io& io, std::vector<Overlap>& overlaps) {
  const auto members = [](Overlap& overlap) {
    auto& [grain_i, grain_j, shift, area, normal_force, normal, point, tangential_force] = overlap;
    return std::tie(grain_i, grain_j, shift, area, normal_force, normal, point, tangential_force);
  };
  transfer_rows(io, "/overlaps", overlaps, members,
                {{"grain_i", ""},
                 {"grain_j", ""},
                 {"shift", ""},
                 {"area", "cm+2"},
                 {"normal_force", "dyn"},
                 {"normal", ""},
                 {"point", "cm"},
                 {"tangential_force", "dyn"}});
}

template <class Io>
void transfer_events(Io& io, std::vector<BeamEvent>& events) {
  const auto members = [](BeamEvent& event) {
    auto& [time, body_i, body_j, mode, broken] = event;
    return std::tie(time, body_i, body_j, mode, broken);
  };
  transfer_rows(io, "/events", events, members,
                {{"time", "s"}, {"body_i", ""}, {"body_j", ""}, {"mode", ""}, {"broken", ""}});
}

template <class Io>
void transfer_packing(Io& io, TrianglePacking& packing) {
  auto& [cell, bodies, corner, angle, grains, links, beams, overlaps, events] = packing;
  auto& [id, position, velocity, spin, radius, mass, inertia] = bodies;
  const std::string group = "/particles/triangles";
  const std::size_t n = io.count(group + "/id", id.size());
  io.box(group + "/box", cell);
  io.array(group + "/id", id, n, "");
  io.element(group + "/position", position, n, "cm");
  io.element(group + "/angle", angle, n, "rad");
  io.element(group + "/velocity", velocity, n, "cm s-1");
  io.element(group + "/spin", spin, n, "s-1");
  io.array(group + "/corner", corner, n, "cm");
  io.array(group + "/radius", radius, n, "cm");
  io.array(group + "/mass", mass, n, "g");
  io.array(group + "/inertia", inertia, n, "g cm+2");
  transfer_grains(io, grains);
  transfer_beams(io, links, beams);
  transfer_overlaps(io, overlaps);
  transfer_events(io, events);
}

template <class Io>
void transfer_memory(Io& io, TriangleMemory& memory) {
  auto& [half_velocity, half_spin, force, torque, derivatives, spin_derivatives, candidate_position, candidate_angle,
         wall_position, wall_angle, pairs, lists] = memory;
  transfer_memory_array(io, "half_velocity", half_velocity, "cm s-1");
  transfer_memory_array(io, "half_spin", half_spin, "s-1");
  transfer_memory_array(io, "force", force, "dyn");
  transfer_memory_array(io, "torque", torque, "dyn cm");
  transfer_memory_array(io, "derivatives", derivatives, "cm");
  transfer_memory_array(io, "spin_derivatives", spin_derivatives, "rad");
  transfer_memory_array(io, "candidate_position", candidate_position, "cm");
  transfer_memory_array(io, "candidate_angle", candidate_angle, "rad");
  transfer_memory_array(io, "wall_position", wall_position, "cm");
  transfer_memory_array(io, "wall_angle", wall_angle, "rad");
  const auto members = [](PairMemory<GrainHistory>& pair) {
    auto& [i, j, shift, history] = pair;
    auto& [tangential_force] = history;
    return std::tie(i, j, shift, tangential_force);
  };
  transfer_rows(io, "/solver/pairs", pairs, members,
                {{"i", ""}, {"j", ""}, {"shift", ""}, {"tangential_force", "dyn"}});
  transfer_lists(io, lists, "cm");
}

template <class Io>
void transfer_law(Io& io, TriangleLaw& law) {
  auto& [contact, modulus, overlap_length, friction, tangential_stiffness, damping, failure, limit_tension, limit_shear,
         limit_bending, limit_stretch, limit_angle] = law;
  io.choice("/law", "contact", contact, kContactLawNames);
  io.value("/law", "modulus", modulus);
  io.value("/law", "overlap_length", overlap_length);
  io.value("/law", "friction", friction);
  io.value("/law", "tangential_stiffness", tangential_stiffness);
  io.value("/law", "damping", damping);
  io.choice("/law", "failure", failure, kBeamFailureNames);
  io.value("/law", "limit_tension", limit_tension);
  io.value("/law", "limit_shear", limit_shear);
  io.value("/law", "limit_bending", limit_bending);
  io.value("/law", "limit_stretch", limit_stretch);
  io.value("/law", "limit_angle", limit_angle);
}

}  // namespace isostat
