#include "analysis/rigidity/part_of_packing.hpp"

#include "geometry/base/index.hpp"

#include <unordered_map>

namespace isostat {

Packing<2> part_of(const Packing<2>& packing, const std::vector<std::int32_t>& grains,
                   const std::vector<std::int32_t>& links) {
  Packing<2> part;
  part.cell = packing.cell;
  std::unordered_map<std::int32_t, std::int32_t> number;  // no array over all grains: clusters are many and small
  const auto local = [&](std::int32_t grain) {
    const auto [at, fresh] = number.try_emplace(grain, static_cast<std::int32_t>(part.bodies.position.size()));
    if (fresh) {
      const auto g = idx(grain);
      part.bodies.id.push_back(packing.bodies.id[g]);
      part.bodies.position.push_back(packing.bodies.position[g]);
      part.bodies.radius.push_back(packing.bodies.radius[g]);
    }
    return at->second;
  };
  number.reserve(grains.size());
  for (std::int32_t g : grains) local(g);
  for (std::int32_t l : links) {
    Link<2> link = packing.links[idx(l)];
    link.i = local(link.i), link.j = local(link.j);
    if (link.kind == LinkKind::beam) {
      part.beams.push_back(packing.beams[idx(link.beam)]);
      link.beam = static_cast<std::int32_t>(part.beams.size()) - 1;
    }
    part.links.push_back(link);
  }
  return part;
}

}  // namespace isostat
