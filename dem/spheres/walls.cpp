#include "dem/spheres/walls.hpp"

#include <cmath>

#include "dem/spheres/pairs.hpp"

namespace isostat {
namespace {

Vec3 without(const Vec3& v, const Vec3& n) { return v - dot(v, n) * n; }

void shorten(Vec3& x, double limit) {
  const double size = norm(x);
  if (size > limit) x = (limit / size) * x;
}

// T, normal to the normal of the step before, turned with it; a wall has no spin to turn it about n.
Vec3 carried(const Vec3& spring, const WallFrame& now, const WallFrame& before) {
  return spring - (dot(spring, now.n) / (1 + dot(before.n, now.n))) * (before.n + now.n);
}

}  // namespace

WallFrame wall_frame(const SphereWall& wall, const Vec3& position) {
  const Vec3 r = position - wall.point;
  if (wall.shape == WallShape::plane) return {wall.normal, dot(wall.normal, r)};
  const double from_centre = norm(r);
  if (!(from_centre > 0)) return {{{0, 0, 1}}, wall.radius};  // any direction serves: the wall is far
  return {(-1 / from_centre) * r, wall.radius - from_centre};
}

WallLoad wall_load(const SphereLaw& law, const SphereWall& wall, const SphereConstants& sphere, const Vec3& position,
                   const WallMotion& motion, double time_step, Vec3& spring) {
  const WallFrame frame = wall_frame(wall, position);
  const double gap = frame.distance - sphere.radius;
  if (!(gap < 0)) {
    spring = {};
    return {};
  }
  const Vec3& n = frame.n;
  const double arm = frame.distance / sphere.radius;
  const ContactStiffness c = wall_stiffness(law, sphere.radius);
  const double elastic = repulsion(law, c, gap);
  const double damping = 2 * law.damping * std::sqrt(sphere.mass * normal_stiffness(law, c, gap));
  WallLoad load{true, {}, {}};
  load.force = (elastic - damping * dot(n, motion.velocity - wall.velocity)) * n;
  if (!(law.wall_friction > 0)) return load;

  const Vec3 half = motion.half_velocity - wall.velocity;
  const double limit = law.wall_friction * elastic;
  const WallFrame before = wall_frame(wall, position - time_step * half);
  const double gap_before = before.distance - sphere.radius;
  spring = carried(spring, frame, before);
  if (law.normal == NormalForce::hertz && gap_before < gap) spring = std::sqrt(gap / gap_before) * spring;
  // The lever arm of the middle of the step (kernel/pair_force_impl.hpp).
  const WallFrame middle = wall_frame(wall, position - 0.5 * time_step * half);
  const Vec3 slip = without(half - (middle.distance / sphere.radius) * cross(motion.half_surface, middle.n), n);
  spring -= tangential_stiffness(law, c, gap) * time_step * slip;
  shorten(spring, limit);
  const Vec3 slide = without(motion.velocity - wall.velocity, n) - arm * cross(motion.surface, n);
  Vec3 tangential = spring - law.tangential_damping * damping * slide;
  shorten(tangential, limit);
  load.force += tangential;
  load.moment_per_radius = -arm * cross(n, tangential);
  return load;
}

}  // namespace isostat
