#include "dem/triangles/grain_split.hpp"

#include <algorithm>
#include <numeric>

#include "geometry/base/index.hpp"
#include "geometry/union_find.hpp"

namespace isostat {
namespace {

// values[k] = old[from[k]], where there are any.
template <class T>
void rearrange(std::vector<T>& values, const std::vector<std::size_t>& from) {
  if (values.empty()) return;
  std::vector<T> now;
  now.reserve(from.size());
  for (const std::size_t k : from) now.push_back(values[k]);
  values = std::move(now);
}

// All arrays over triangles but those over walls: triangle k is the one that was from[k].
void rearrange_triangles(State<TriangleGrains>& s, const std::vector<std::size_t>& from) {
  TrianglePacking& p = s.packing;
  Bodies<2>& b = p.bodies;
  rearrange(b.id, from), rearrange(b.position, from), rearrange(b.velocity, from), rearrange(b.spin, from);
  rearrange(b.radius, from), rearrange(b.mass, from), rearrange(b.inertia, from);
  rearrange(p.corner, from), rearrange(p.angle, from);
  TriangleMemory& m = s.memory;
  rearrange(m.half_velocity, from), rearrange(m.half_spin, from), rearrange(m.force, from), rearrange(m.torque, from);
  rearrange(m.derivatives, from), rearrange(m.spin_derivatives, from);
  rearrange(m.candidate_position, from), rearrange(m.candidate_angle, from);
}

}  // namespace

void drop_broken_beams(State<TriangleGrains>& s) {
  TrianglePacking& p = s.packing;
  TriangleMemory& m = s.memory;
  std::vector<Link<2>> links;
  std::vector<Beam> beams;
  UnionFind sets(p.bodies.size());
  for (Link<2> link : p.links) {
    const Beam& beam = p.beams[idx(link.beam)];
    if (!(beam.stiffness > 0)) continue;
    link.beam = static_cast<std::int32_t>(beams.size());
    beams.push_back(beam), links.push_back(link);
    sets.join(idx(link.i), idx(link.j));
  }
  // Parts of a grain in the order of their first triangles.
  Grains grains;
  grains.begin.push_back(0);
  std::vector<std::size_t> from;
  std::vector<bool> whole(p.grains.size(), true);
  std::int64_t next_id = p.grains.id.empty() ? 0 : *std::max_element(p.grains.id.begin(), p.grains.id.end()) + 1;
  std::vector<std::int32_t> new_index(p.grains.size());
  for (std::size_t g = 0; g < p.grains.size(); ++g) {
    const std::size_t begin = idx(p.grains.begin[g]), end = idx(p.grains.begin[g + 1]);
    new_index[g] = static_cast<std::int32_t>(grains.size());
    std::vector<std::size_t> roots;
    const bool rigid = p.grains.part[g] != GrainPart::free;
    for (std::size_t k = begin; k < end; ++k) {
      const std::size_t root = rigid ? begin : sets.find(k);
      if (std::find(roots.begin(), roots.end(), root) != roots.end()) continue;
      roots.push_back(root);
    }
    whole[g] = roots.size() == 1;
    for (std::size_t r = 0; r < roots.size(); ++r) {
      for (std::size_t k = begin; k < end; ++k)
        if ((rigid ? begin : sets.find(k)) == roots[r]) from.push_back(k);
      grains.id.push_back(r == 0 ? p.grains.id[g] : next_id++);
      grains.begin.push_back(static_cast<std::int32_t>(from.size()));
      grains.part.push_back(p.grains.part[g]), grains.radius.push_back(whole[g] ? p.grains.radius[g] : 0.0);
    }
  }
  std::vector<std::int32_t> to(from.size());
  for (std::size_t k = 0; k < from.size(); ++k) to[from[k]] = static_cast<std::int32_t>(k);
  for (Link<2>& link : links) link.i = to[idx(link.i)], link.j = to[idx(link.j)];
  std::stable_sort(links.begin(), links.end(), [&](const Link<2>& a, const Link<2>& b) { return a.i < b.i; });
  rearrange_triangles(s, from);
  std::erase_if(m.pairs, [&](const PairMemory<GrainHistory>& q) { return !whole[idx(q.i)] || !whole[idx(q.j)]; });
  for (PairMemory<GrainHistory>& q : m.pairs) q.i = new_index[idx(q.i)], q.j = new_index[idx(q.j)];
  p.grains = std::move(grains), p.links = std::move(links), p.beams = std::move(beams);
  p.overlaps.clear();
  m.lists = {};
}

void remove_grains(State<TriangleGrains>& s, const std::vector<bool>& gone) {
  TrianglePacking& p = s.packing;
  TriangleMemory& m = s.memory;
  Grains grains;
  grains.begin.push_back(0);
  std::vector<std::size_t> from, wall_from;
  std::vector<std::int32_t> new_index(p.grains.size(), -1), new_triangle(p.bodies.size(), -1);
  std::size_t wall = 0;
  for (std::size_t g = 0; g < p.grains.size(); ++g) {
    const bool driven = p.grains.part[g] != GrainPart::free;
    for (std::size_t k = idx(p.grains.begin[g]); k < idx(p.grains.begin[g + 1]); ++k) {
      if (!gone[g]) new_triangle[k] = static_cast<std::int32_t>(from.size()), from.push_back(k);
      if (!gone[g] && driven) wall_from.push_back(wall);
      wall += driven;
    }
    if (gone[g]) continue;
    new_index[g] = static_cast<std::int32_t>(grains.size());
    grains.id.push_back(p.grains.id[g]), grains.part.push_back(p.grains.part[g]);
    grains.radius.push_back(p.grains.radius[g]);
    grains.begin.push_back(static_cast<std::int32_t>(from.size()));
  }
  std::vector<Link<2>> links;
  std::vector<Beam> beams;
  for (Link<2> link : p.links) {
    if (new_triangle[idx(link.i)] < 0) continue;
    beams.push_back(p.beams[idx(link.beam)]);
    link.i = new_triangle[idx(link.i)], link.j = new_triangle[idx(link.j)];
    link.beam = static_cast<std::int32_t>(links.size());
    links.push_back(link);
  }
  rearrange_triangles(s, from);
  rearrange(m.wall_position, wall_from), rearrange(m.wall_angle, wall_from);
  const auto lost = [&](std::int32_t i, std::int32_t j) { return gone[idx(i)] || gone[idx(j)]; };
  std::erase_if(p.overlaps, [&](const Overlap& o) { return lost(o.grain_i, o.grain_j); });
  for (Overlap& o : p.overlaps) o.grain_i = new_index[idx(o.grain_i)], o.grain_j = new_index[idx(o.grain_j)];
  std::erase_if(m.pairs, [&](const PairMemory<GrainHistory>& q) { return lost(q.i, q.j); });
  for (PairMemory<GrainHistory>& q : m.pairs) q.i = new_index[idx(q.i)], q.j = new_index[idx(q.j)];
  p.grains = std::move(grains), p.links = std::move(links), p.beams = std::move(beams);
  m.lists = {};
}

}  // namespace isostat
