// What happens when a stage of a scene begins: velocities, time step, and what the cell is held by.
#pragma once
#include "dem/scene/scene.hpp"
#include "dem/solver/barostat.hpp"
#include "dem/state/state.hpp"

namespace isostat {

// The opening actions; progress and cell motion start anew, velocities are drawn if the stage says so, and the time
// step is set for the stiffest contacts that the stage will have.
void open_stage(State& state, const StageScene& stage);

// How the cell is held during the stage; M in units of m.
CellControl cell_control(const State& state, const StageScene& stage);

// Measured sigma_11, sigma_22 from static forces [F0/a]; needs a cell.
Vec2 static_stress(const State& state);

}  // namespace isostat
