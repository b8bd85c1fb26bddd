#include "dem/spheres/stage.hpp"

#include <cmath>

#include "dem/solver/agitation.hpp"

namespace isostat {

void prepare_stage(State<Spheres>& s, const StageScene& stage) {
  if (!stage.friction) return;
  s.law.friction = s.law.wall_friction = *stage.friction;
  if (*stage.friction > 0) {
    const SphereLaw asked = resolve(s.scene.sphere_law);
    s.law.tangential_stiffness = asked.tangential_stiffness;
  }
}

void agitate(State<Spheres>& s, const StageScene& stage) {
  if (stage.velocity > 0) draw_velocities(s, stage.velocity * std::sqrt(s.law.attraction * s.law.attraction_range));
}

bool event_met(const State<Spheres>&, const StageScene&) { return false; }

std::string event_missing(const State<Spheres>&, const StageScene&) { return "no such event among spheres"; }

}  // namespace isostat
