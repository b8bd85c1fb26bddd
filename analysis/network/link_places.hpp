// Faces of a cluster of links drawn in the plane as straight lines between the centres of its grains.
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "analysis/network/stressed_clusters.hpp"

namespace isostat {

// The place of each of these links, which connect all their grains and do not wind around the cell. None if the drawing
// has crossings that its Euler characteristic shows (deep overlaps): then there is no outer face.
std::optional<std::vector<LinkPlace>> link_places(const Packing<2>& packing, const std::vector<std::int32_t>& links);

}  // namespace isostat
