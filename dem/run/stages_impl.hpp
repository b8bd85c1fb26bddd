// run_stages<System> written out; included where a system instantiates it. Of the system it wants, beside its types:
// prepare_stage, agitate, law_changes, law_at (dem/disks/run.cpp), evaluate_certificate, loaded_contacts, event_met,
// event_missing, open_outlet, take_away, grains_above_outlet (dem/disks/outflow.hpp), count_free of its packing.
#pragma once
#include "dem/input_error.hpp"
#include "dem/run/stage_run.hpp"
#include "dem/run/stages.hpp"
#include "dem/solver/clocks.hpp"
#include "dem/state/container_motion.hpp"

namespace isostat {

template <class System>
RunOutcome run_stages(State<System>& state, const SolverOptions& options, const RunHooks<System>& hooks,
                      StaticSolver<System>* finisher) {
  if (state.scene.finish.method == Finish::newton && !finisher)
    throw InputError("scene", 0, "finish.method", "newton", "needs a static solver, and this program brings none");
  RunOutcome outcome;
  const double wall_start = wall_seconds(), cpu_start = cpu_seconds(options.threads);
  const auto stages = static_cast<std::int32_t>(state.scene.stages.size());
  const std::int64_t first_step = state.step;
  Observers<System> observers(hooks);
  while (state.progress.stage < stages) {
    if (!state.progress.started) open_stage(state, state.scene.stages[static_cast<std::size_t>(state.progress.stage)]);
    StageRun<System> run(state, options, hooks, observers, finisher);
    const std::optional<StageOutcome> stage = run.run();
    outcome.times += run.times();
    outcome.interrupted = !stage;
    if (outcome.interrupted) break;
    outcome.stages.push_back(*stage);
    if (!stage->met) state.progress.add_unmet("stage " + std::to_string(stage->stage) + ": " + stage->reason);
    bring_forward(state.surroundings, state.scene.stages[static_cast<std::size_t>(state.progress.stage)].container,
                  state.time - state.progress.start_time);
    ++state.progress.stage;
    state.progress.started = false;
    if (hooks.stage_end) hooks.stage_end(state);
    if (observers.checkpoint_due() && state.progress.stage < stages) observers.checkpoint(state);
    if (hooks.max_time > 0 && state.time >= hooks.max_time) break;
  }
  outcome.steps = state.step - first_step;
  outcome.wall_seconds = wall_seconds() - wall_start;
  outcome.cpu_seconds = cpu_seconds(options.threads) - cpu_start;
  return outcome;
}

}  // namespace isostat
