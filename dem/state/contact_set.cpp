#include "dem/state/contact_set.hpp"

#include <algorithm>

namespace isostat {
namespace {

// All bits of the result depend on all bits of x (the finalizer of SplitMix64).
std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

}  // namespace

template <int D>
std::uint64_t contact_set(const Packing<D>& packing) {
  std::uint64_t sum = 0;
  for (const Link<D>& l : packing.links) {
    if (!is_contact(l.kind)) continue;
    const auto a = static_cast<std::uint64_t>(packing.bodies.id[static_cast<std::size_t>(l.i)]);
    const auto b = static_cast<std::uint64_t>(packing.bodies.id[static_cast<std::size_t>(l.j)]);
    sum += mixed(mixed(std::min(a, b) + 1) + std::max(a, b));
  }
  return sum;
}

template std::uint64_t contact_set(const Packing<2>&);
template std::uint64_t contact_set(const Packing<3>&);

}  // namespace isostat
