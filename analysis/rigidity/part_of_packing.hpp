// A part of a packing as a packing of its own: some grains and links, in the same cell. For rank and stress of a
// cluster.
#pragma once
#include <cstdint>
#include <vector>

#include "dem/state/packing.hpp"

namespace isostat {

// `grains` in this order, then what else the links join, in the order of the links; beams follow their links. Of the
// bodies only id, position and radius are filled.
Packing<2> part_of(const Packing<2>& packing, const std::vector<std::int32_t>& grains,
                   const std::vector<std::int32_t>& links);

}  // namespace isostat
