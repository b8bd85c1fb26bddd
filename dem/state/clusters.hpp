// Clusters of a packing: connected components of its grains under all links; a grain alone is a cluster.
#pragma once
#include <cstddef>

#include "dem/state/packing.hpp"

namespace isostat {

template <int D>
std::size_t count_clusters(const Packing<D>& packing);

}  // namespace isostat
