#include "analysis/rigidity/part_of_packing.hpp"

#include <algorithm>
#include <unordered_map>

#include "geometry/base/index.hpp"

namespace isostat {
namespace {

// In the order of the part. number: will hold the members; no array over all bodies, for clusters are many and small.
template <class Network>
std::vector<std::int32_t> members_of(const Network& network, const std::vector<std::int32_t>& bodies,
                                     const std::vector<std::int32_t>& links,
                                     std::unordered_map<std::int32_t, std::int32_t>& number) {
  std::vector<std::int32_t> members;
  const auto take = [&](std::int32_t body) {
    if (number.try_emplace(body, 0).second) members.push_back(body);
  };
  number.reserve(bodies.size());
  for (const std::int32_t b : bodies) take(b);
  for (const std::int32_t l : links)
    network.each_bond(idx(l), [&](std::int32_t i, std::int32_t j, const auto&) { take(i), take(j); });
  std::stable_partition(members.begin(), members.end(), [&](std::int32_t b) { return network.is_free(b); });
  return members;
}

}  // namespace

OwnedSpheres part_of(const SphereNetwork& network, const std::vector<std::int32_t>& bodies,
                     const std::vector<std::int32_t>& links) {
  const Packing<3>& packing = network.packing;
  std::unordered_map<std::int32_t, std::int32_t> number;
  OwnedSpheres part;
  part.packing.cell = packing.cell;
  for (const std::int32_t body : members_of(network, bodies, links, number)) {
    number[body] = static_cast<std::int32_t>(part.packing.bodies.id.size());
    part.packing.bodies.id.push_back(packing.bodies.id[idx(body)]);
    part.packing.bodies.position.push_back(packing.bodies.position[idx(body)]);
    part.packing.bodies.radius.push_back(packing.bodies.radius[idx(body)]);
    if (!packing.part.empty()) part.packing.part.push_back(packing.part[idx(body)]);
  }
  for (const std::int32_t l : links) {
    Link<3> link = packing.links[idx(l)];
    link.i = number[link.i], link.j = number[link.j];
    part.packing.links.push_back(link);
  }
  return part;
}

OwnedNetwork part_of(const LinkNetwork& network, const std::vector<std::int32_t>& bodies,
                     const std::vector<std::int32_t>& links) {
  const Packing<2>& packing = network.packing;
  std::unordered_map<std::int32_t, std::int32_t> number;
  const std::vector<std::int32_t> members = members_of(network, bodies, links, number);

  OwnedNetwork part;
  part.packing.cell = packing.cell;
  for (const std::int32_t body : members) {
    const auto b = idx(body);
    number[body] = static_cast<std::int32_t>(part.packing.bodies.position.size());
    part.free += network.is_free(body);
    part.packing.bodies.id.push_back(packing.bodies.id[b]);
    part.packing.bodies.position.push_back(packing.bodies.position[b]);
    part.packing.bodies.radius.push_back(packing.bodies.radius[b]);
    if (!packing.part.empty()) part.packing.part.push_back(packing.part[b]);
    if (network.of_triangles()) part.corners.push_back(network.corners[b]), part.grain.push_back(network.grain[b]);
  }
  for (const std::int32_t l : links) {
    if (network.is_area(idx(l))) {
      AreaLink area = network.area(idx(l));
      for (AreaPair& p : area.pairs) p.i = number[p.i], p.j = number[p.j];
      part.areas.push_back(std::move(area));
      continue;
    }
    Link<2> link = packing.links[idx(l)];
    link.i = number[link.i], link.j = number[link.j];
    if (link.kind == LinkKind::beam) {
      part.packing.beams.push_back(packing.beams[idx(link.beam)]);
      link.beam = static_cast<std::int32_t>(part.packing.beams.size()) - 1;
    }
    part.packing.links.push_back(link);
  }
  return part;
}

}  // namespace isostat
