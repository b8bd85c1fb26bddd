#include "dem/triangles/state_check.hpp"

#include "dem/triangles/at_rest.hpp"

#include <algorithm>
#include <string>

namespace isostat {

using namespace state_check;

namespace {

using Broken = std::optional<StateFault>;

const char* const kTriangles = "particles/triangles";

bool in_range(std::int32_t k, std::size_t n) { return k >= 0 && static_cast<std::size_t>(k) < n; }

Broken check_triangles(const TrianglePacking& p) {
  const std::size_t n = p.bodies.size();
  const std::string group = kTriangles;
  if (p.corner.size() != n || p.angle.size() != n) return StateFault{group, "arrays of different lengths"};
  if (auto f = check_values(p.angle, group + "/angle")) return f;
  if (auto f = check_values(p.corner, group + "/corner")) return f;
  for (std::size_t k = 0; k < n; ++k) {
    const auto& [a, b, c] = p.corner[k];
    const Vec2 u = b - a, v = c - a;
    if (!(u[0] * v[1] - u[1] * v[0] > 0))
      return StateFault{group + "/corner", "triangle " + std::to_string(k) + " is flat or has its corners clockwise"};
  }
  return std::nullopt;
}

Broken check_grains(const Grains& g, std::size_t triangles) {
  const std::size_t n = g.size();
  if (g.part.size() != n || g.radius.size() != n) return StateFault{"grains", "arrays of different lengths"};
  std::vector<std::int64_t> ids = g.id;
  std::sort(ids.begin(), ids.end());
  if (const auto twice = std::adjacent_find(ids.begin(), ids.end()); twice != ids.end())
    return StateFault{"grains/id", std::to_string(*twice) + " occurs twice"};
  if (auto f = check_values(g.radius, "grains/radius", true)) return f;
  for (std::size_t k = 0; k < n; ++k)
    if (g.part[k] > GrainPart::lid)
      return StateFault{"grains/part", "grain " + std::to_string(k) + " is part of nothing"};
  const std::vector<std::int32_t>& begin = g.begin;
  const bool none = n == 0 && begin.empty();
  if (!none && begin.size() != n + 1) return StateFault{"grains/begin", "needs one element more than there are grains"};
  if (!none && begin.front() != 0) return StateFault{"grains/begin", "does not begin with triangle 0"};
  for (std::size_t k = 0; k < n; ++k)
    if (begin[k + 1] <= begin[k]) return StateFault{"grains/begin", "grain " + std::to_string(k) + " has no triangle"};
  if ((none ? 0 : static_cast<std::size_t>(begin.back())) != triangles)
    return StateFault{"grains/begin", "does not end with the last triangle"};
  return std::nullopt;
}

Broken check_beams(const TrianglePacking& p) {
  const std::size_t n = p.bodies.size();
  const std::vector<std::int32_t> grain = grain_of(p.grains);
  if (p.links.size() != p.beams.size()) return StateFault{"beams", "there is not one link for each beam"};
  std::vector<bool> used(p.beams.size(), false);
  for (std::size_t k = 0; k < p.links.size(); ++k) {
    const Link<2>& l = p.links[k];
    const std::string which = "link " + std::to_string(k);
    if (l.kind != LinkKind::beam) return StateFault{"links/kind", which + " is no beam"};
    if (!in_range(l.i, n) || !in_range(l.j, n) || l.i >= l.j)
      return StateFault{"links/i", which + " does not join a triangle to a later one"};
    if (grain[static_cast<std::size_t>(l.i)] != grain[static_cast<std::size_t>(l.j)])
      return StateFault{"links/i", which + " joins two grains"};
    if (!p.cell && l.shift != ImageShift<2>{})
      return StateFault{"links/shift", which + " crosses a cell that is not there"};
    if (!in_range(l.beam, p.beams.size()) || used[static_cast<std::size_t>(l.beam)])
      return StateFault{"links/beam", which + " names a beam that is not there or another link's"};
    used[static_cast<std::size_t>(l.beam)] = true;
    if (!finite(l.gap) || !finite(l.normal_force) || !finite(l.tangential_force) || !finite(l.moment))
      return StateFault{"links", which + " has a gap, force or moment that is not a finite number"};
  }
  for (std::size_t k = 0; k < p.beams.size(); ++k) {
    const auto& [length, angle_i, angle_j, stiffness, bending] = p.beams[k];
    for (const double x : {length, angle_i, angle_j, stiffness, bending})
      if (!finite(x)) return StateFault{"beams", "beam " + std::to_string(k) + " has a number that is not finite"};
    if (!(length > 0) || stiffness < 0 || bending < 0)
      return StateFault{"beams", "beam " + std::to_string(k) + " has no length, or a negative stiffness"};
  }
  return std::nullopt;
}

Broken check_overlaps(const TrianglePacking& p) {
  for (std::size_t k = 0; k < p.overlaps.size(); ++k) {
    const Overlap& o = p.overlaps[k];
    const std::string which = "overlap " + std::to_string(k);
    if (!in_range(o.grain_i, p.grains.size()) || !in_range(o.grain_j, p.grains.size()) || o.grain_i >= o.grain_j)
      return StateFault{"overlaps/i", which + " does not name a grain and a later one"};
    if (!p.cell && o.shift != ImageShift<2>{})
      return StateFault{"overlaps/shift", which + " crosses a cell that is not there"};
    if (!finite(o.area) || !(o.area > 0)) return StateFault{"overlaps/area", which + " has no positive, finite area"};
    if (!finite(o.normal_force) || !finite(o.normal) || !finite(o.point) || !finite(o.tangential_force))
      return StateFault{"overlaps", which + " has a force, direction or point that is not finite"};
  }
  return std::nullopt;
}

Broken check_events(const std::vector<BeamEvent>& events) {
  for (std::size_t k = 0; k < events.size(); ++k) {
    const std::string which = "event " + std::to_string(k);
    if (!finite(events[k].time)) return StateFault{"events/time", which + " has a time that is not finite"};
    if (k > 0 && events[k].time < events[k - 1].time)
      return StateFault{"events/time", which + " is earlier than the one before"};
    if (events[k].mode > BeamMode::bending) return StateFault{"events/mode", which + " has an unknown mode"};
  }
  return std::nullopt;
}

// Of wall and lid grains.
std::size_t wall_triangles(const Grains& g) {
  std::size_t n = 0;
  for (std::size_t k = 0; k < g.size(); ++k)
    if (g.part[k] != GrainPart::free) n += static_cast<std::size_t>(g.begin[k + 1] - g.begin[k]);
  return n;
}

}  // namespace

std::optional<StateFault> packing_fault(const TrianglePacking& p) {
  if (auto f = bodies_fault(p.bodies, kTriangles)) return f;
  if (auto f = cell_fault(p.cell, kTriangles)) return f;
  if (p.cell && p.cell->tilt != 0)
    return StateFault{std::string(kTriangles) + "/box/tilt", "the cell of triangles stands upright"};
  if (auto f = check_triangles(p)) return f;
  if (auto f = check_grains(p.grains, p.bodies.size())) return f;
  if (auto f = check_beams(p)) return f;
  if (auto f = check_overlaps(p)) return f;
  return check_events(p.events);
}

std::optional<StateFault> memory_fault(const TriangleMemory& m, const TrianglePacking& p) {
  const std::size_t n = p.bodies.size(), grains = p.grains.size(), listed = listed_grains(p),
                    walls = wall_triangles(p.grains);
  const auto& [half_velocity, half_spin, force, torque, derivatives, spin_derivatives, candidate_position,
               candidate_angle, wall_position, wall_angle, pairs, lists] = m;
  for (const std::size_t size :
       {half_velocity.size(), half_spin.size(), force.size(), torque.size(), derivatives.size(),
        spin_derivatives.size(), candidate_position.size(), candidate_angle.size()})
    if (size != n && size != 0) return StateFault{"solver", "an array has neither one element a triangle nor none"};
  for (const std::size_t size : {wall_position.size(), wall_angle.size()})
    if (size != walls && size != 0)
      return StateFault{"solver", "an array has neither one element a triangle of a wall nor none"};
  for (const std::size_t size : {lists.outer_position.size(), lists.inner_position.size()})
    if (size != listed && size != 0)
      return StateFault{"solver", "an array has neither one element a grain, smooth walls left out, nor none"};
  if (auto f = check_values(half_velocity, "solver/half_velocity")) return f;
  if (auto f = check_values(half_spin, "solver/half_spin")) return f;
  if (auto f = check_values(force, "solver/force")) return f;
  if (auto f = check_values(torque, "solver/torque")) return f;
  if (auto f = check_values(derivatives, "solver/derivatives")) return f;
  if (auto f = check_values(spin_derivatives, "solver/spin_derivatives")) return f;
  if (auto f = check_values(candidate_position, "solver/candidate_position")) return f;
  if (auto f = check_values(candidate_angle, "solver/candidate_angle")) return f;
  if (auto f = check_values(wall_position, "solver/wall_position")) return f;
  if (auto f = check_values(wall_angle, "solver/wall_angle")) return f;
  for (const PairMemory<GrainHistory>& pair : pairs)
    if (!names_two_bodies(pair, grains) || !finite(pair.history.tangential_force))
      return StateFault{"solver/pairs", "a pair does not join two grains or has a force that is not a finite number"};
  return lists_fault(lists);
}

std::optional<StateFault> law_fault(const TriangleLaw& law) {
  const auto& [contact, modulus, overlap_length, friction, tangential_stiffness, damping, failure, tension, shear,
               bending, stretch, angle] = law;
  if (contact > ContactLaw::paper || failure > BeamFailure::yield) return StateFault{"law", "a law that is not known"};
  for (const double x : {modulus, overlap_length, friction, tangential_stiffness, damping})
    if (!finite(x) || x < 0) return StateFault{"law", "a parameter that is negative or not a finite number"};
  for (const double x : {tension, shear, bending, stretch, angle})
    if (!(x >= 0)) return StateFault{"law", "a limit of the beams that is negative or not a number"};
  return std::nullopt;
}

}  // namespace isostat
