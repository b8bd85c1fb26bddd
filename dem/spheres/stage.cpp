#include "dem/spheres/stage.hpp"

#include <algorithm>
#include <cmath>

#include "dem/solver/agitation.hpp"
#include "dem/spheres/sample.hpp"

namespace isostat {
namespace {

void stop(State<Spheres>& s) {
  const auto still = [](std::vector<Vec3>& v) { std::fill(v.begin(), v.end(), Vec3{}); };
  still(s.packing.bodies.velocity), still(s.packing.bodies.spin);
  still(s.memory.half_velocity), still(s.memory.half_spin);
  for (SphereWall& wall : s.packing.walls) wall.velocity = {};
}

// The first soft-particle goes on with its grains and shell at the speed of the stage.
void set_approach(State<Spheres>& s, double speed) {
  for (SphereWall& shell : s.packing.walls) {
    if (shell.shape != WallShape::shell || shell.group != kFirstSoft) continue;
    const Vec3 boost = speed * kSoftApproach - shell.velocity;
    if (boost == Vec3{}) return;
    shell.velocity += boost;
    for (std::size_t k = 0; k < s.packing.bodies.size(); ++k) {
      if (s.packing.group[k] != kFirstSoft) continue;
      s.packing.bodies.velocity[k] += boost;
      if (!s.memory.half_velocity.empty()) s.memory.half_velocity[k] += boost;
    }
  }
}

}  // namespace

void prepare_stage(State<Spheres>& s, const StageScene& stage) {
  if (stage.stop) stop(s);
  set_approach(s, stage.approach);
  if (!stage.friction) return;
  SphereLawScene law = s.scene.sphere_law;
  law.friction = *stage.friction;
  s.law = resolve(s.scene.sphere_grains, law);
  if (s.packing.kind.empty()) s.law = without_unlike(s.law);
}

void agitate(State<Spheres>& s, const StageScene& stage) {
  if (stage.velocity > 0) draw_velocities(s, drawn_speed(s, stage));
}

bool event_met(const State<Spheres>&, const StageScene&) { return false; }

std::string event_missing(const State<Spheres>&, const StageScene&) { return "no such event among spheres"; }

}  // namespace isostat
