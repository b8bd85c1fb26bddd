// What G is made of in space: spheres and their links. A view, the twin of LinkNetwork.
#pragma once
#include <cstddef>
#include <cstdint>

#include "dem/state/packing.hpp"

namespace isostat {

struct SphereNetwork {
  const Packing<3>& packing;  // the free bodies first
  std::int32_t free = 0;      // bodies from here on are held: they have no columns

  // Implicit: every packing of spheres is a network. With walls in it, put_free_first() comes before.
  SphereNetwork(const Packing<3>& p);

  bool is_free(std::int32_t body) const { return body < free; }
  bool any_held() const { return static_cast<std::size_t>(free) < packing.bodies.size(); }
  std::size_t links() const { return packing.links.size(); }
  // f(i, j, shift of j) for the bodies of a link.
  template <class F>
  void each_bond(std::size_t link, F&& f) const {
    f(packing.links[link].i, packing.links[link].j, packing.links[link].shift);
  }
};

// Walls and lids become the last bodies; else the order stays.
void put_free_first(Packing<3>& packing);

// A network with the memory behind it.
struct OwnedSpheres {
  Packing<3> packing;
  SphereNetwork view() const { return {packing}; }
};

}  // namespace isostat
