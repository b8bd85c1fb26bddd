// A state of grains of triangles with every member set to something, no physics in it, and all its numbers in a row.
#pragma once
#include <cstdint>
#include <vector>

#include "dem/triangles/triangles.hpp"

namespace isostat {

// Two squares of four triangles and beams, and between them in storage a grain of a wall and one of a lid; memory,
// overlaps, one of them through the cell if there is one, and events.
State<TriangleGrains> random_triangle_state(std::uint64_t seed, bool with_cell = true);

// Every number of packing, law, memory, surroundings and clock, sizes of lists included.
std::vector<double> all_numbers(const State<TriangleGrains>& state);

}  // namespace isostat
