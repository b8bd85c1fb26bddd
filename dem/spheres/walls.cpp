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

// T turned with the normal by the tilt (kernel/transport.hpp); a wall has no spin to turn it about n.
Vec3 carried(const Vec3& spring, const Vec3& n, const Vec3& tilt) {
  const double along = dot(spring, n);
  return spring - along * n + (along * (0.5 - 0.125 * dot(tilt, tilt))) * tilt;
}

// What is left of a spring where the overlap, and with it k_T, has become less.
double softened(const SphereLaw& law, const ContactStiffness& c, double gap, double before) {
  if (c.is_soft()) {
    const double was = tangential_stiffness(law, c, before);
    return was > 0 ? tangential_stiffness(law, c, gap) / was : 0.0;
  }
  return law.normal == NormalForce::hertz ? std::sqrt(gap / before) : 1.0;
}

}  // namespace

WallFrame wall_frame(const SphereWall& wall, const Vec3& position) {
  const Vec3 r = position - wall.point;
  if (wall.shape == WallShape::plane) return {wall.normal, dot(wall.normal, r), 0};
  const double from_centre = norm(r);
  if (!(from_centre > 0)) return {{{0, 0, 1}}, wall.radius, 0};  // any direction serves: the wall is far
  const double inverse = 1 / from_centre;
  if (wall.shape == WallShape::ball) return {inverse * r, from_centre - wall.radius, inverse};
  return {-inverse * r, wall.radius - from_centre, -inverse};
}

WallLoad wall_load(const WallLaw& wall_law, const SphereWall& wall, const SphereBody& body, double mass,
                   const Vec3& position, const WallMotion& motion, double time_step, Vec3& spring) {
  const SphereLaw& law = wall_law.law;
  const WallFrame frame = wall_frame(wall, position);
  const double gap = frame.distance - body.radius;
  if (!(gap < 0)) {
    spring = {};
    return {};
  }
  const Vec3& n = frame.n;
  const ContactStiffness c = wall_law.stiffness(body, wall);
  const double elastic = repulsion(law, c, gap);
  const double damping = 2 * law.damping * std::sqrt(mass * normal_stiffness(law, c, gap));
  const Vec3 velocity = motion.velocity - wall.velocity;
  WallLoad load{true, {}, {}};
  load.force = (elastic - damping * dot(n, velocity)) * n;
  if (!(c.friction > 0)) return load;

  // As between two spheres (kernel/pair_force_impl.hpp): lever arm of the middle of the step, no chord for a distance.
  const Vec3 half = motion.half_velocity - wall.velocity, moved = time_step * without(half, n);
  const Vec3 tilt = frame.bend * moved;
  const double receded = time_step * dot(n, half) - 0.5 * frame.bend * dot(moved, moved);
  const double limit = c.friction * elastic, per_radius = 1 / body.radius;
  spring = carried(spring, n, tilt);
  if (receded > 0) spring = softened(law, c, gap, gap - receded) * spring;
  const double middle = (frame.distance - 0.5 * receded) * per_radius;
  const Vec3 slip = without(half - middle * cross(motion.half_surface, n - 0.5 * tilt), n);
  spring -= tangential_stiffness(law, c, gap) * time_step * slip;
  shorten(spring, limit);
  const double arm = frame.distance * per_radius;
  const Vec3 slide = without(velocity, n) - arm * cross(motion.surface, n);
  Vec3 tangential = spring - law.tangential_damping * damping * slide;
  shorten(tangential, limit);
  load.force += tangential;
  load.moment_per_radius = -arm * cross(n, tangential);
  return load;
}

}  // namespace isostat
