// The outlet of a hopper among grains of triangles (dem/run/outflow.hpp).
#pragma once
#include <cstddef>

#include "dem/triangles/triangles.hpp"

namespace isostat {

// The lid goes.
void open_outlet(State<TriangleGrains>& state);
// Takes away the free grains that have fallen more than container.drop below the outlet, and counts them. True: there
// were some; the memory of the lists is then empty.
bool take_away(State<TriangleGrains>& state);
// Free grains whose centre is not below the outlet.
std::size_t grains_above_outlet(const State<TriangleGrains>& state);

}  // namespace isostat
