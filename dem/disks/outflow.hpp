// Disks that leave a hopper: what the stage runner asks for (dem/run/outflow.hpp).
#pragma once
#include <cstdint>
#include <vector>

#include "dem/disks/disks.hpp"

namespace isostat {

// Takes these bodies, one flag each, from the packing and from all that a solver remembers of them. What stays keeps
// its order. Feet under them go, too.
void remove_bodies(State<Disks>& state, std::vector<char> goes);

// The lids go. Of surroundings only `open` changes.
void open_outlet(State<Disks>& state);

// Free grains whose centre is above the outlet, and taking away those that are container.drop below it: whether there
// was one. They are counted in the surroundings.
std::int64_t grains_above_outlet(const State<Disks>& state);
bool take_away(State<Disks>& state);

}  // namespace isostat
