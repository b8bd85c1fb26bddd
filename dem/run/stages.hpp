// Runs the stages of a scene one after the other, each to its own end.
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "dem/run/finishing.hpp"
#include "dem/solver/solver.hpp"
#include "dem/state/certificate.hpp"
#include "dem/state/state.hpp"

namespace isostat {

// What an observer may see while a stage runs.
struct Progress {
  std::int32_t stage = 0;
  double time = 0;            // [T0]
  double solid_fraction = 0;  // not a number without a cell
  WorstCriterion last;        // the equilibrium criterion furthest from being met
  const Certificate* certificate = nullptr;
};

// Observers read; nothing they ask for changes the run.
template <class System>
struct RunHooks {
  using Look = std::function<void(const State<System>&)>;
  std::function<bool()> interrupted;              // polled a few times a second; true: stop resumably
  std::function<void(const Progress&)> progress;  // at every look at the packing
  Look observe;                                   // at multiples of observe_interval [T0]
  double observe_interval = 0;                    // 0: never
  Look stage_end;                                 // after each stage, with progress at the next
  Look snapshot;                                  // at the scene's output.snapshot_times and _solid_fractions
  Look checkpoint;                                // resumable, every checkpoint_seconds of wall time
  double checkpoint_seconds = 0;                  // 0: never
  double max_time = 0;                            // [T0] of the whole run; 0: no limit. Stages left then are not met.
};

struct StageOutcome {
  std::int32_t stage = 0;
  bool met = false;         // its own end was reached
  double time = 0;          // [T0] at the end
  std::string reason;       // what ended it, or what is missing and the key to turn
  std::int64_t moving = 0;  // an equilibrium by its means, in which so many grains still move (Certificate::moving)
  bool nothing_touches = false;  // an equilibrium of grains that fly
  double inertial_number = 0;    // the largest of the stage, and
  double stress_error = 0;       // the largest (dem/run/loading.hpp); not a number where no network was loaded
};

struct RunOutcome {
  std::vector<StageOutcome> stages;
  bool interrupted = false;  // by the hook; the state is resumable
  std::int64_t steps = 0;    // of this run
  StepTimes times;
  double cpu_seconds = 0, wall_seconds = 0;  // stepping only
  bool all_met() const;
};

// Goes on from wherever state.progress stands, to the end of the last stage. The state is left at the last instant
// with its certificate. Throws RunError if the run blows up, after leaving the last sane snapshot in `state`.
// finish.method = "newton" needs a finisher, else InputError.
template <class System>
RunOutcome run_stages(State<System>& state, const SolverOptions& options, const RunHooks<System>& hooks,
                      StaticSolver<System>* finisher = nullptr);

}  // namespace isostat
