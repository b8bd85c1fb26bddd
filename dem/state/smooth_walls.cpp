#include "dem/state/smooth_walls.hpp"

#include "dem/state/container_walls.hpp"

namespace isostat {

std::vector<SmoothWall> smooth_walls(const ContainerScene& c, double beyond) {
  using Shape = SmoothWall::Shape;
  if (c.shape == ContainerShape::none || c.walls != ContainerWalls::smooth) return {};
  if (c.shape == ContainerShape::drum) return {{Shape::circle, {}, {{c.radius, 0}}, GrainPart::wall}};
  std::vector<SmoothWall> walls;
  for (const FlatWall& w : flat_walls(c)) {
    const Vec2 along = (beyond / norm(w.b - w.a)) * (w.b - w.a);
    walls.push_back({Shape::line, w.joined_a ? w.a - along : w.a, w.joined_b ? w.b + along : w.b, w.part});
  }
  return walls;
}

SmoothWall wall_at(const ContainerPlacement& p, const SmoothWall& built) {
  return {built.shape, point_at(p, built.a), point_at(p, built.b), built.part};
}

FootPoint foot_point(const SmoothWall& wall, const Vec2& centre) {
  const Vec2 arm = centre - wall.a, way = wall.b - wall.a;
  if (wall.shape == SmoothWall::Shape::circle) {
    const double from_axis = norm(arm), radius = norm(way);
    if (!(from_axis > 0)) return {wall.b, 0};
    return {wall.a + (radius / from_axis) * arm, (from_axis < radius ? -1 : 1) / from_axis};
  }
  const double part = dot(arm, way) / dot(way, way);
  if (part > 0 && part < 1) {
    const Vec2 inwards = (1 / norm(way)) * Vec2{{-way[1], way[0]}};
    return {centre - dot(arm, inwards) * inwards,
            0};  // straight below: nothing along a wall that has an axis' direction
  }
  const Vec2 end = part > 0 ? wall.b : wall.a;
  const double distance = norm(centre - end);
  return {end, distance > 0 ? 1 / distance : 0};
}

}  // namespace isostat
