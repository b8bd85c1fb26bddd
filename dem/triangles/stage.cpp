#include "dem/triangles/stage.hpp"

#include "geometry/base/index.hpp"

namespace isostat {

void prepare_stage(State<TriangleGrains>& s, const StageScene&) {
  s.memory.wall_position.clear(), s.memory.wall_angle.clear();
}

bool event_met(const State<TriangleGrains>& s, const StageScene&) {
  const TrianglePacking& p = s.packing;
  if (p.grains.size() != 2 || !p.overlaps.empty()) return false;
  Vec2 centre[2], velocity[2];
  for (std::size_t g = 0; g < 2; ++g) {
    double mass = 0;
    for (auto k = idx(p.grains.begin[g]); k < idx(p.grains.begin[g + 1]); ++k) {
      mass += p.bodies.mass[k];
      centre[g] += p.bodies.mass[k] * p.bodies.position[k], velocity[g] += p.bodies.mass[k] * p.bodies.velocity[k];
    }
    centre[g] = (1 / mass) * centre[g], velocity[g] = (1 / mass) * velocity[g];
  }
  return dot(centre[1] - centre[0], velocity[1] - velocity[0]) > 0;
}

std::string event_missing(const State<TriangleGrains>& s, const StageScene&) {
  if (s.packing.grains.size() != 2) return "separated is an end for two grains";
  return s.packing.overlaps.empty() ? "the grains have not yet collided" : "the grains still touch";
}

}  // namespace isostat
