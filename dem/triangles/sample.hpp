// The initial state of a scene of grains of triangles: at rest in random places without overlap, two squares about to
// collide, or the packing of a file.
#pragma once
#include <cstdint>

#include "dem/triangles/container.hpp"
#include "dem/triangles/grain_template.hpp"
#include "dem/triangles/time_step.hpp"
#include "dem/triangles/triangles.hpp"

namespace isostat {

// The law with its defaults filled in.
TriangleLaw resolve(const TriangleLawScene& law);

// A grain with its centroid at `centre`, turned by `angle`, without load and at rest. The ids of its triangles follow
// that of the last triangle.
void append_grain(TrianglePacking& packing, const GrainTemplate& grain, const Vec2& centre, double angle,
                  GrainPart part, std::int64_t id);

// A state before its first stage: grains, walls, law, time step. Throws InputError if the grains cannot be placed, or
// the file cannot be started from.
State<TriangleGrains> initial_triangles(const Scene& scene, std::uint64_t seed);

// Of a scene without grains.file.
State<TriangleGrains> place_triangles(const Scene& scene, std::uint64_t seed);

// Of a scene with it, from the state read from this path: grains, their velocities and friction springs at time 0 under
// the scene's law. Beams take stiffness and bending of the scene and keep what they have yielded. Walls stay where they
// are if the container is that of the scene, and are built anew otherwise.
State<TriangleGrains> start_from(const State<TriangleGrains>& file, const std::string& path, const Scene& scene,
                                 std::uint64_t seed);

}  // namespace isostat
