// A part of a packing as a packing of its own: some grains and links, in the same cell. For rank and stress of a
// cluster.
#pragma once
#include <cstdint>
#include <vector>

#include "analysis/link_network.hpp"
#include "analysis/sphere_network.hpp"

namespace isostat {

// `bodies` in this order, then what else the links join, in the order of the links; held ones last. links: of
// LinkNetwork, ascending; beams follow their links. Of the bodies only id, position and radius are filled.
OwnedNetwork part_of(const LinkNetwork& network, const std::vector<std::int32_t>& bodies,
                     const std::vector<std::int32_t>& links);
OwnedSpheres part_of(const SphereNetwork& network, const std::vector<std::int32_t>& bodies,
                     const std::vector<std::int32_t>& links);

}  // namespace isostat
