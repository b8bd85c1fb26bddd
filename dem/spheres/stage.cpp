#include "dem/spheres/stage.hpp"

#include <cmath>

#include "dem/solver/agitation.hpp"
#include "dem/spheres/sample.hpp"

namespace isostat {
namespace {

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
  set_approach(s, stage.approach);
  if (!stage.friction) return;
  SphereLawScene law = s.scene.sphere_law;
  law.friction = *stage.friction;
  s.law = resolve(law);
}

void agitate(State<Spheres>& s, const StageScene& stage) {
  if (stage.velocity > 0) draw_velocities(s, drawn_speed(s, stage));
}

bool event_met(const State<Spheres>&, const StageScene&) { return false; }

std::string event_missing(const State<Spheres>&, const StageScene&) { return "no such event among spheres"; }

}  // namespace isostat
