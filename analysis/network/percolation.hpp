// Percolation threshold of the force network (Gilabert 2007, Sec. IV.B.1).
#pragma once
#include <optional>
#include <string>

#include "dem/state/packing.hpp"

namespace isostat {

struct Percolation {
  double force = 0;  // F_perc [F0]: links with |F| >= F_perc wrap around the cell, those with |F| > F_perc do not
  std::array<int, 2> winding{};   // of the first loop that wraps [cells]
  std::string direction() const;  // axes along which it wraps: "x", "y" or "xy"
};

// None if even the whole network does not wrap. Contacts and distant pairs both carry. Needs a cell.
// O(links log links).
std::optional<Percolation> force_percolation(const Packing<2>& packing);

}  // namespace isostat
