#include "analysis/link_network.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <tuple>

#include "analysis/free_first.hpp"
#include "dem/triangles/at_rest.hpp"
#include "dem/triangles/touching_triangles.hpp"
#include "geometry/base/index.hpp"
#include "geometry/triangle_overlap.hpp"

namespace isostat {
namespace {

using Grains3 = std::tuple<std::int32_t, std::int32_t, ImageShift<2>>;

std::vector<AreaLink> area_links(const TrianglePacking& p, const std::vector<Triangle>& corners,
                                 const TriangleLaw& law) {
  const ConnectedOverlaps found = connected_overlaps(p, corners);
  std::map<Grains3, std::vector<const Overlap*>> records;
  for (const Overlap& o : p.overlaps) records[{o.grain_i, o.grain_j, o.shift}].push_back(&o);
  const std::vector<double> inverse = inverse_lengths(p, law);
  std::vector<AreaLink> links;
  for (std::size_t first = 0, last; first < found.overlap.size(); first = last) {
    const ConnectedOverlap& head = found.overlap[first];
    const Grains3 key{head.grain_i, head.grain_j, head.shift};
    for (last = first; last < found.overlap.size(); ++last) {
      const ConnectedOverlap& o = found.overlap[last];
      if (Grains3{o.grain_i, o.grain_j, o.shift} != key) break;
    }
    const auto& known = records[key];
    const bool each = known.size() == last - first && known.size() > 1;
    for (std::size_t k = first; k < last; ++k) {
      if (k == first || each) {
        AreaLink& fresh = links.emplace_back();
        fresh.grain_i = head.grain_i, fresh.grain_j = head.grain_j, fresh.shift = head.shift;
        if (known.size() > k - first) links.back().tangential_force = known[k - first]->tangential_force;
      }
      AreaLink& link = links.back();
      for (const TriangleTouch& t : found.of(found.overlap[k])) {
        const Triangle b = image_of(corners[idx(t.j)], p.cell, t.shift);
        link.pairs.push_back({t.i, t.j, t.shift, overlap_boundary(triangle_signs(corners[idx(t.i)], b))});
        link.area += triangle_overlap(corners[idx(t.i)], b).area;
      }
    }
    for (std::size_t k = links.size() - (each ? last - first : 1); k < links.size(); ++k) {
      AreaLink& link = links[k];
      link.stiffness = overlap_stiffness(law, inverse[idx(link.grain_i)], inverse[idx(link.grain_j)]);
      link.pressure = link.stiffness * link.area;
      link.tangential_stiffness = law.tangential_stiffness;
    }
  }
  return links;
}

}  // namespace

LinkNetwork::LinkNetwork(const Packing<2>& p) : packing(p), free(static_cast<std::int32_t>(count_free(p))) {
  for (std::size_t k = 0; k < idx(free); ++k)
    if (!isostat::is_free(p.part, k)) throw std::invalid_argument("walls come after the free bodies of a network");
}

void put_free_first(Packing<2>& packing) { put_free_bodies_first(packing); }

OwnedNetwork triangle_network(const TrianglePacking& p, const std::vector<Triangle>& corners, const TriangleLaw& law) {
  OwnedNetwork n;
  n.packing.cell = p.cell;
  const std::vector<std::int32_t> grain = grain_of(p.grains);
  std::vector<std::int32_t> order(p.bodies.size()), place(p.bodies.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = static_cast<std::int32_t>(k);
  const auto free = [&](std::int32_t k) { return p.grains.part[idx(grain[idx(k)])] == GrainPart::free; };
  std::stable_partition(order.begin(), order.end(), free);
  Bodies<2>& b = n.packing.bodies;
  for (const std::int32_t k : order) {
    const auto from = idx(k);
    place[from] = static_cast<std::int32_t>(b.id.size());
    n.free += free(k);
    b.id.push_back(p.bodies.id[from]), b.position.push_back(p.bodies.position[from]);
    b.velocity.push_back(p.bodies.velocity[from]), b.spin.push_back(p.bodies.spin[from]);
    b.radius.push_back(p.bodies.radius[from]), b.mass.push_back(p.bodies.mass[from]);
    b.inertia.push_back(p.bodies.inertia[from]);
    n.corners.push_back(corners[from]), n.grain.push_back(grain[from]);
  }
  for (const Link<2>& l : p.links) {
    if (!free(l.i) && !free(l.j)) continue;
    Link<2> link = l;
    link.i = place[idx(l.i)], link.j = place[idx(l.j)];
    link.beam = static_cast<std::int32_t>(n.packing.beams.size());
    n.packing.beams.push_back(p.beams[idx(l.beam)]);
    n.packing.links.push_back(link);
  }
  n.areas = area_links(p, corners, law);
  for (AreaLink& a : n.areas)
    for (AreaPair& pair : a.pairs) pair.i = place[idx(pair.i)], pair.j = place[idx(pair.j)];
  return n;
}

}  // namespace isostat
