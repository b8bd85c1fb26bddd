// Grains that have come apart, and grains that go.
#pragma once
#include <vector>

#include "dem/triangles/triangles.hpp"

namespace isostat {

// Takes beams without stiffness away; a grain whose triangles its beams no longer join becomes one grain for each part,
// the first with the id of the whole and the others with new ids beyond the largest. Arrays over triangles, memory
// included, follow; friction springs of grains that came apart are forgotten. Empties the memory of the lists.
void drop_broken_beams(State<TriangleGrains>& state);

// Takes grains away, with their triangles, beams, overlaps and memory. Empties the memory of the lists.
void remove_grains(State<TriangleGrains>& state, const std::vector<bool>& gone);

}  // namespace isostat
