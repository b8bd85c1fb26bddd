// A number for the set of contacts, the same for any order of grains and contacts: two states with equal numbers have,
// but for one chance in 2^64, the same contacts. Distant pairs do not count.
#pragma once
#include <cstdint>

#include "dem/state/packing.hpp"

namespace isostat {

template <int D>
std::uint64_t contact_set(const Packing<D>& packing);

}  // namespace isostat
