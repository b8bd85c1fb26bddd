// Smooth walls as round grains meet them: at the foot point, the point of the wall that is nearest to the grain's
// centre. A contact with one is a link whose far end is a body of radius 0 there (dem/state/link.hpp).
#pragma once
#include <vector>

#include "dem/scene/surroundings.hpp"
#include "dem/state/container_motion.hpp"
#include "dem/state/grain_part.hpp"
#include "geometry/vec.hpp"

namespace isostat {

struct SmoothWall {
  enum class Shape { line, circle };
  Shape shape = Shape::line;
  Vec2 a, b;  // line: its ends; circle: its centre and a point of it
  GrainPart part = GrainPart::wall;
};

// As they are built, a lid among them; the place in the list is a wall's number. Lines go on by `beyond` where another
// wall joins them: a grain in a corner sees the half-planes of both. Empty unless the container has smooth walls.
std::vector<SmoothWall> smooth_walls(const ContainerScene& container, double beyond);

SmoothWall wall_at(const ContainerPlacement& placement, const SmoothWall& built);

// Those of a state, where they stand; without the lid of an outlet that is open.
template <class System>
std::vector<SmoothWall> smooth_walls_of(const State<System>& s) {
  std::vector<SmoothWall> walls;
  const ContainerPlacement placement = container_of(s);
  for (const SmoothWall& w : smooth_walls(s.scene.container, 0))
    if (!s.surroundings.open || w.part != GrainPart::lid) walls.push_back(wall_at(placement, w));
  return walls;
}

struct FootPoint {
  Vec2 place;
  // [1/length] By how much the normal turns when the wall passes the grain along the tangent: 0 on a line, 1/distance
  // at its end, the negative inverse of the distance from the centre inside a circle.
  double turning = 0;
};
FootPoint foot_point(const SmoothWall& wall, const Vec2& centre);

}  // namespace isostat
