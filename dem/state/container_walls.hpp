// The flat walls of a box or a hopper, as they are built, for every system.
#pragma once
#include <vector>

#include "dem/scene/surroundings.hpp"
#include "dem/state/grain_part.hpp"
#include "geometry/vec.hpp"

namespace isostat {

// From a to b, with the room on the left. It is continued beyond an end where another wall joins it, so that grains
// find no gap there.
struct FlatWall {
  Vec2 a, b;
  bool joined_a = true, joined_b = true;
  GrainPart part = GrainPart::wall;
};

// In the order in which one walks round the room; none of a drum.
std::vector<FlatWall> flat_walls(const ContainerScene& container);

}  // namespace isostat
