// What a stage asks of grains of triangles beyond what all systems share (dem/run/stage_run.hpp).
#pragma once
#include <string>

#include "dem/triangles/triangles.hpp"

namespace isostat {

// Where the walls stand now is where the stage finds them.
void prepare_stage(State<TriangleGrains>& state, const StageScene& stage);
inline void agitate(State<TriangleGrains>&, const StageScene&) {}  // stage.velocity is a key of disks
inline bool law_changes(const State<TriangleGrains>&, const StageScene&) { return false; }
inline TriangleLaw law_at(const State<TriangleGrains>& state, const StageScene&, double) { return state.law; }

// Two grains that touch no more and recede from each other.
bool event_met(const State<TriangleGrains>& state, const StageScene& stage);
std::string event_missing(const State<TriangleGrains>& state, const StageScene& stage);

}  // namespace isostat
