// What a stage asks of disks beyond what all systems share (dem/run/stage_run.hpp): their time step, drawn velocities,
// contacts that are stiffened.
#pragma once
#include <string>

#include "dem/disks/disks.hpp"

namespace isostat {

// The time step, right for the stiffest contacts of a stage in which K_N changes (half-step velocities are those at
// time - dt/2), and the K_N from which it starts.
void prepare_stage(State<Disks>& state, const StageScene& stage);

// Maxwell velocities with the drift of the centre of mass removed and the rms of |v| equal to stage.velocity V*; spins
// zero. Nothing if the stage draws none.
void agitate(State<Disks>& state, const StageScene& stage);

// Whether K_N is on its way to what the stage wants, and the law on this way at a time [T0]: exponential from what it
// was when the stage began.
bool law_changes(const State<Disks>& state, const StageScene& stage);
DiskLaw law_at(const State<Disks>& state, const StageScene& stage, double time);

// The ends that are events of the surroundings, and what is missing for them.
bool event_met(const State<Disks>& state, const StageScene& stage);
std::string event_missing(const State<Disks>& state, const StageScene& stage);

}  // namespace isostat
