#include "dem/disks/stage.hpp"

#include <algorithm>
#include <cmath>

#include "dem/disks/sample.hpp"
#include "dem/solver/agitation.hpp"

namespace isostat {

void prepare_stage(State<Disks>& s, const StageScene& stage) {
  s.progress.start_stiffness = s.law.normal_stiffness;
  const double stiffest = std::max(s.law.normal_stiffness, stage.normal_stiffness.value_or(0));
  const double dt = time_step(s.scene, stiffest, s.packing), earlier = 0.5 * (s.time_step - dt);
  if (dt == s.time_step || dt == 0) return;  // 0: nothing is left
  s.time_step = dt;
  DiskMemory& m = s.memory;
  const Bodies<2>& b = s.packing.bodies;
  for (std::size_t k = 0; k < std::min(m.half_velocity.size(), s.packing.grains()); ++k) {
    m.half_velocity[k] += (earlier / b.mass[k]) * m.force[k];
    m.half_spin[k] += earlier * m.torque[k] / b.inertia[k];
  }
}

void agitate(State<Disks>& s, const StageScene& stage) {
  if (stage.velocity > 0) draw_velocities(s, drawn_speed(s, stage));
}

bool event_met(const State<Disks>& s, const StageScene&) {
  const Bodies<2>& b = s.packing.bodies;
  if (b.size() != 2 || !s.packing.links.empty()) return false;
  return dot(b.position[1] - b.position[0], b.velocity[1] - b.velocity[0]) > 0;
}

std::string event_missing(const State<Disks>& s, const StageScene&) {
  if (s.packing.bodies.size() != 2) return "separated is an end for two grains";
  return s.packing.links.empty() ? "the grains have not yet collided" : "the grains still touch";
}

bool law_changes(const State<Disks>& s, const StageScene& stage) {
  return stage.normal_stiffness && s.law.normal_stiffness != *stage.normal_stiffness;
}

DiskLaw law_at(const State<Disks>& s, const StageScene& stage, double time) {
  const double from = s.progress.start_stiffness, to = *stage.normal_stiffness;
  const double part = (time - s.progress.start_time) / stage.stiffening_time;
  LawScene law = s.scene.law;
  law.normal_stiffness = part < 1 ? from * std::pow(to / from, part) : to;
  return resolve(law);
}

}  // namespace isostat
