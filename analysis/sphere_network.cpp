#include "analysis/sphere_network.hpp"

#include <stdexcept>

#include "analysis/free_first.hpp"

namespace isostat {

SphereNetwork::SphereNetwork(const Packing<3>& p) : packing(p), free(static_cast<std::int32_t>(count_free(p))) {
  for (std::size_t k = 0; k < idx(free); ++k)
    if (!isostat::is_free(p.part, k)) throw std::invalid_argument("walls come after the free bodies of a network");
}

void put_free_first(Packing<3>& packing) { put_free_bodies_first(packing); }

}  // namespace isostat
