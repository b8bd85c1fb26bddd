// Which links of a packing are between grains.
#pragma once
#include <algorithm>
#include <cstddef>

#include "dem/state/packing.hpp"

namespace isostat {

// Not a contact of a grain with a smooth wall.
template <int D>
bool joins_grains(const Packing<D>& packing, const Link<D>& link) {
  return static_cast<std::size_t>(std::max(link.i, link.j)) < packing.grains();
}

}  // namespace isostat
