// Digest of the physical state: two states with the same digest hold the same grains, beams, overlaps, events, cell,
// law, surroundings and time, whatever the order in which the grains are stored.
#pragma once
#include <string>

#include "dem/triangles/triangles.hpp"

namespace isostat {

// XXH3-128, 32 hexadecimal digits, over the name of the system, time, law in the order of the file, cell and its rate,
// grains in the order of their ids with their triangles in theirs, beams by the ids of their triangles, overlaps with
// the smaller id first in the order of ids and shift, events, gravity and surroundings; -0 counts as 0. The circles of
// triangles and grains follow from the corners and are left out.
std::string physical_hash(const State<TriangleGrains>& state);

}  // namespace isostat
