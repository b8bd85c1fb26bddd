// Contact of a sphere with a rigid wall, sphere by sphere: the law of a pair (dem/spheres/sphere_law.hpp) whose other
// body has no curvature and no spin and infinite mass, with the friction of walls.
#pragma once
#include <cmath>

#include "dem/spheres/at_rest.hpp"
#include "dem/spheres/sphere_store.hpp"
#include "dem/spheres/spheres.hpp"

namespace isostat {

inline bool acts_on(const SphereWall& wall, std::int32_t group, SphereKind kind) {
  return kind != SphereKind::shell && (wall.group == SphereWall::kEveryGroup || wall.group == group);
}

struct WallFrame {
  Vec3 n;           // from the wall to the sphere
  double distance;  // [a] of the centre from the wall
  double bend;      // [1/a] n turns by bend times the displacement along the wall: 0 at a plane
};
WallFrame wall_frame(const SphereWall& wall, const Vec3& position);

// The law at walls with what of it is the same for all grains.
struct WallLaw {
  explicit WallLaw(const SphereLaw& of) : law(of), unit(wall_stiffness(of, 1)) {}
  ContactStiffness stiffness(const SphereBody& body, const SphereWall& wall) const {
    if (body.kind != SphereKind::grain || wall.shape == WallShape::ball) return wall_stiffness(law, body, wall);
    const double root = law.normal == NormalForce::hertz ? std::sqrt(body.radius) : 1;
    return {unit.normal * root, unit.tangential * root, unit.friction, {}};
  }
  const SphereLaw& law;
  ContactStiffness unit;  // of radius 1
};

// The sphere's motion in a step: half-step and predicted velocities and surface speeds R w.
struct WallMotion {
  Vec3 half_velocity, half_surface, velocity, surface;
};
struct WallLoad {
  bool touches = false;
  Vec3 force{}, moment_per_radius{};  // on the sphere
};
// Stretches the spring by the motion over the time step, and gives the load with viscous parts.
WallLoad wall_load(const WallLaw& law, const SphereWall& wall, const SphereBody& body, double mass,
                   const Vec3& position, const WallMotion& motion, double time_step, Vec3& spring);

// The wall with its point moved on by its velocity.
inline void move_wall(SphereWall& wall, double time_step) { wall.point += time_step * wall.velocity; }

}  // namespace isostat
