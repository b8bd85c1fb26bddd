// Digest of the physical state: two states with the same digest hold the same grains, links, cell, law and time,
// whatever the order of storage, the number of threads, or the way the file was written.
#pragma once
#include <string>

#include "dem/disks/disks.hpp"

namespace isostat {

// XXH3-128, 32 hexadecimal digits, over time, law, cell and its rate, bodies in the order of their ids, links with
// the smaller id first in the order of ids and shift, and gravity and surroundings where there are any; -0
// counts as 0.
std::string physical_hash(const State<Disks>& state);

}  // namespace isostat
