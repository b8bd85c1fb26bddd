// The system of spheres in space: its types alone, no kernel in sight, so that analysis can read states without
// reaching the solver.
#pragma once
#include <cstdint>
#include <string_view>
#include <vector>

#include "dem/spheres/sphere_law.hpp"
#include "dem/state/list_memory.hpp"
#include "dem/state/packing.hpp"
#include "dem/state/state.hpp"

namespace isostat {

enum class WallShape : std::uint8_t { plane, shell, ball };

// A rigid wall: a plane with the grains on the side of its normal, a spherical shell around them, or a ball that they
// press from without. It acts on the grains of its group alone, one of group kEveryGroup on all of them.
struct SphereWall {
  static constexpr std::int32_t kEveryGroup = -1;
  WallShape shape = WallShape::plane;
  Vec3 point{};       // [a] of the plane; the centre of a shell or ball
  Vec3 normal{};      // unit vector of a plane
  double radius = 0;  // [a] of a shell or ball
  Vec3 velocity{};    // [a/T0]
  std::int32_t group = kEveryGroup;
  friend bool operator==(const SphereWall&, const SphereWall&) = default;
};

// Contact of a sphere with a wall: a link whose far end is the foot point on the wall. n points from the wall to the
// sphere; the force on the sphere is N n + T.
struct WallLink {
  std::int32_t body = 0, wall = 0;
  LinkKind kind = LinkKind::closed;
  double gap = 0;           // [a] h < 0
  double normal_force = 0;  // [F0]
  Vec3 tangential_force{};  // [F0] on the sphere
};

struct SpherePacking : Packing<3> {
  std::vector<std::int32_t> group;  // of the bodies, from 0; empty: all in group 0
  std::vector<SphereKind> kind;     // empty: all grains of the first material
  std::vector<SphereWall> walls;
  std::vector<WallLink> wall_links;
};

// Springs of a contact: T on j, and the rolling moment M on j.
struct SphereHistory {
  Vec3 tangential_force{};  // [F0]
  Vec3 moment{};            // [F0 a]
  friend bool operator==(const SphereHistory&, const SphereHistory&) = default;
};

// Spring of a sphere at a wall.
struct WallSpring {
  std::int32_t body = 0, wall = 0;
  Vec3 tangential_force{};  // [F0] on the sphere
};

// What a restart needs beside the packing: leapfrog half-step velocities, the total forces at `time`, lists and
// springs.
struct SphereMemory {
  std::vector<Vec3> half_velocity;  // [a/T0] at time - dt/2
  std::vector<Vec3> half_spin;      // [1/T0]
  std::vector<Vec3> force;          // [F0] total, viscous part included
  std::vector<Vec3> torque;         // [F0 a]
  std::vector<PairMemory<SphereHistory, 3>> pairs;
  std::vector<WallSpring> wall_springs;
  ListMemory<3> lists;
};

class SphereEngine;

struct Spheres {
  static constexpr std::string_view name = "spheres";
  static constexpr int dimension = 3;
  using Packing = SpherePacking;
  using Law = SphereLaw;
  using Memory = SphereMemory;
  using Engine = SphereEngine;
};

}  // namespace isostat
