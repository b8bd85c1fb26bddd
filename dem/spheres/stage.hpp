// What a stage asks of spheres beyond what all systems share (dem/run/stage_run.hpp): their time step, friction of the
// stage, drawn velocities. No event, no outlet.
#pragma once
#include <string>

#include "dem/spheres/spheres.hpp"

namespace isostat {

// Friction as stage.friction says, from this stage on, and the speed of a soft-particle as stage.approach says.
void prepare_stage(State<Spheres>& state, const StageScene& stage);

// Maxwell velocities as of disks: no drift, rms |v| = stage.velocity V*, spins zero. Nothing if the stage draws none.
void agitate(State<Spheres>& state, const StageScene& stage);

inline bool law_changes(const State<Spheres>&, const StageScene&) { return false; }
inline SphereLaw law_at(const State<Spheres>& state, const StageScene&, double) { return state.law; }

bool event_met(const State<Spheres>& state, const StageScene& stage);
std::string event_missing(const State<Spheres>& state, const StageScene& stage);

inline void open_outlet(State<Spheres>&) {}
inline bool take_away(State<Spheres>&) { return false; }
inline std::int64_t grains_above_outlet(const State<Spheres>& s) {
  return static_cast<std::int64_t>(s.packing.bodies.size());
}

}  // namespace isostat
