// The walls of a container as grains of triangles, at rest where they are built. They may overlap each other and never
// reach into the room that they enclose (dem/state/container_region.hpp).
//
//   smooth   a rectangle along each wall, so large that an overlap takes it for a half-plane
//            (dem/triangles/at_rest.hpp); a drum has a polygon of them
//   grains   squares in rows, every other one set back by half its side: teeth that grains grip between
#pragma once
#include <vector>

#include "dem/scene/surroundings.hpp"
#include "dem/triangles/grain_template.hpp"
#include "dem/triangles/triangles.hpp"

namespace isostat {

struct WallGrain {
  GrainTemplate shape;
  Vec2 centre;
  double angle = 0;
  GrainPart part = GrainPart::wall;
};

// largest: the largest free grain. A lid closes the outlet of a hopper.
std::vector<WallGrain> wall_grains(const ContainerScene& container, const GrainTemplate& largest,
                                   const GrainMaterial& material);

}  // namespace isostat
