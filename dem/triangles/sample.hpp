// The initial state of a scene of grains of triangles.
#pragma once
#include <cstdint>

#include "dem/triangles/triangles.hpp"

namespace isostat {

// A state before its first stage: grains, walls, law, time step. Throws InputError if the grains cannot be placed.
State<TriangleGrains> initial_triangles(const Scene& scene, std::uint64_t seed);

}  // namespace isostat
