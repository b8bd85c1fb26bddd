// Percolation threshold of the force network (Gilabert 2007, Sec. IV.B.1).
#pragma once
#include <optional>
#include <string>

#include "dem/state/packing.hpp"

namespace isostat {

template <int D>
struct Percolation {
  double force = 0;  // F_perc [F0]: links with |F| >= F_perc wrap around the cell, those with |F| > F_perc do not
  ImageShift<D> winding{};        // of the first loop that wraps [cells]
  std::string direction() const;  // axes along which it wraps: "x", "y", "xy", "xyz"
};

// None if even the whole network does not wrap. Contacts and distant pairs both carry. Needs a cell.
// O(links log links).
template <int D>
std::optional<Percolation<D>> force_percolation(const Packing<D>& packing);

}  // namespace isostat
