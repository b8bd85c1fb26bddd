// Where a sphere's contact with a wall is: the point of the wall nearest to the centre.
#pragma once
#include "dem/spheres/spheres.hpp"

namespace isostat {

inline Vec3 foot_on(const SphereWall& wall, const Vec3& centre) {
  const Vec3 d = centre - wall.point;
  if (wall.shape == WallShape::plane) return centre - dot(d, wall.normal) * wall.normal;
  const double distance = norm(d);
  return distance > 0 ? wall.point + (wall.radius / distance) * d : centre;
}

}  // namespace isostat
