// Small states of grains of triangles, built by hand: for what looks at states and never marches them.
#pragma once
#include <cstdint>
#include <string>

#include "dem/triangles/triangles.hpp"

namespace isostat {

// Adds a grain at rest (dem/triangles/grain_shape.hpp names the shapes), its centroid at `place`, turned by `angle`.
// The index of the grain.
std::int32_t add_grain(TrianglePacking& packing, const std::string& shape, double size, const Vec2& place,
                       double angle = 0, GrainPart part = GrainPart::free);

// Overlap of two grains, as wide as given: the force on the later one, at a point between the two, in any direction.
void add_overlap(TrianglePacking& packing, std::int32_t grain_i, std::int32_t grain_j, const Vec2& point,
                 const Vec2& force_on_j);

// Nine squares, a rod, an L and a star on a floor of wall squares with a lid in its middle, between two long smooth
// walls; overlaps where they touch; beams of the lowest squares under load; one beam of the L broken; the upper grains
// move and turn. The same every time.
State<TriangleGrains> small_bed();

}  // namespace isostat
