// Grains that have come apart.
#pragma once
#include "dem/triangles/triangles.hpp"

namespace isostat {

// Takes beams without stiffness away; a grain whose triangles its beams no longer join becomes one grain for each part,
// the first with the id of the whole and the others with new ids beyond the largest. Arrays over triangles, memory
// included, follow; friction springs of grains that came apart are forgotten. Empties the memory of the lists.
void drop_broken_beams(State<TriangleGrains>& state);

}  // namespace isostat
