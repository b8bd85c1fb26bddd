// One stage from wherever it stands to its end.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "dem/run/finishing_policy.hpp"
#include "dem/run/observers.hpp"
#include "dem/run/outflow.hpp"
#include "dem/run/stage_end.hpp"
#include "dem/run/stages.hpp"

namespace isostat {

template <class System>
class StageRun {
 public:
  StageRun(State<System>& state, const SolverOptions& options, const RunHooks<System>& hooks,
           Observers<System>& observers, StaticSolver<System>* finisher)
      : s_(state),
        stage_(state.scene.stages[static_cast<std::size_t>(state.progress.stage)]),
        hooks_(hooks),
        options_(options),
        observers_(observers),
        finisher_(finisher),
        end_(state, stage_),
        policy_(state, stage_),
        outflow_(state, stage_),
        solver_(std::in_place, state, cell_control(state, stage_), options),
        interval_(check_interval(state.time_step)),
        slice_(std::max<std::int64_t>(
            1, kGrainStepsPerSlice / static_cast<std::int64_t>(state.packing.bodies.size() + 1))) {
    if (s_.progress.drag_on) solver_->set_drag(s_.scene.finish.drag);
    observers_.begin_stage(s_);
  }

  // None when it was interrupted.
  std::optional<StageOutcome> run() {
    for (;;) {
      if (solver_->steps() % interval_ == 0 || end_.reached(solver_->time())) {
        look();
        const bool to_be_solved = policy_.statically_solved() && end_.met();
        if (!to_be_solved)
          if (auto outcome = over()) return outcome;
        if (policy_.acts()) {
          policy_.follow_contacts();
          if (to_be_solved || policy_.only_creep_is_left()) finish();
          if (!interrupted_)
            if (auto outcome = over()) return outcome;
        }
      }
      if (interrupted_ || (hooks_.interrupted && hooks_.interrupted())) {
        take();
        return std::nullopt;
      }
      change_law();
      march();
      observers_.watch(s_, solver_->time(), solver_->cell(), [this] { check_and_take(); });
    }
  }
  StepTimes times() const {
    StepTimes sum = times_before_;
    return sum += solver_->times();
  }

 private:
  static constexpr std::int64_t kLawEvery = 10;                    // [steps] K_N changes by 1e-4 or so each time
  static constexpr std::int64_t kGrainStepsPerSlice = 10'000'000;  // about a tenth of a second between polls

  // Steps between two looks at the packing: half a T0, within reason. A look costs about as much as ten steps.
  static std::int64_t check_interval(double time_step) {
    return std::clamp<std::int64_t>(static_cast<std::int64_t>(std::lround(0.5 / time_step)), 200, 2000);
  }

  // Stiffnesses on their way from what they were to what the stage wants, as a function of time alone.
  void change_law() {
    if (!law_changes(s_, stage_) || solver_->steps() % kLawEvery != 0) return;
    s_.law = law_at(s_, stage_, solver_->time());
    solver_->set_law(s_.law, stage_.stiffening_keeps);
  }

  // To the next step at which anything is to be done.
  void march() {
    std::int64_t steps = std::min(slice_, interval_ - solver_->steps() % interval_);
    if (law_changes(s_, stage_)) steps = std::min(steps, kLawEvery - solver_->steps() % kLawEvery);
    const double stop = std::min(end_.time(), observers_.next_time(s_, solver_->time()));
    if (std::isfinite(stop))
      steps = std::clamp<std::int64_t>(std::llround((stop - solver_->time()) / s_.time_step), 1, steps);
    solver_->run(steps);
  }

  // The state at this instant, with its certificate.
  void take() {
    solver_->snapshot(s_);
    certify();
  }
  void check_and_take() {
    solver_->check_sanity();
    take();
  }
  void certify() {
    const Certificate before = s_.certificate;
    s_.certificate =
        evaluate_certificate(s_.packing, s_.law, s_.imposed_stress, s_.scene.equilibrium, s_.scene.gravity);
    keep_record(s_.certificate, before);
    if (s_.progress.drag_on) s_.certificate.finishing = "drag";
  }
  void look() {
    check_and_take();
    if (outflow_.empties()) {
      begin_again();
      certify();
    }
    follow_loading();
    observers_.look(s_);
  }
  // What the certificate says of the whole stage, and the peak that failure is measured by.
  void follow_loading() {
    Certificate& c = s_.certificate;
    if (c.inertial_number == kNotLookedAt && !(loads_cell(s_, stage_) && has_network(s_)))
      c.inertial_number = c.stress_error = std::numeric_limits<double>::quiet_NaN();
    if (!std::isnan(c.inertial_number)) {
      c.inertial_number = std::max(c.inertial_number, inertial_number(s_));
      c.stress_error = std::max(c.stress_error, stress_error(s_));
    }
    end_.follow_peak();
  }
  // The solver anew, from a state that was changed under it.
  void begin_again() {
    times_before_ += solver_->times();
    solver_.emplace(s_, cell_control(s_, stage_), options_);
    if (s_.progress.drag_on) solver_->set_drag(s_.scene.finish.drag);
    solver_->snapshot(s_);
  }

  // Everything that is decided about a run is decided here, at fixed steps, whoever watches.
  std::optional<StageOutcome> over() {
    const std::string until(name(stage_.until));
    const bool waits = waits_for_equilibrium(stage_.until);
    StageOutcome outcome{s_.progress.stage,
                         true,
                         s_.time,
                         until,
                         waits ? s_.certificate.moving : 0,
                         waits && s_.packing.links.size() == s_.packing.beams.size(),
                         s_.certificate.inertial_number,
                         s_.certificate.stress_error};
    if (end_.met()) return outcome;
    outcome.met = false;
    const std::string unit = " " + std::string(time_unit(s_.scene.system)) + ": ";
    if (const std::optional<std::string> spoilt = end_.spoilt()) {
      outcome.reason = *spoilt;
      return outcome;
    }
    if (hooks_.max_time > 0 && s_.time >= hooks_.max_time) {
      outcome.reason = "stopped by --max-time " + std::to_string(hooks_.max_time) + unit + end_.missing();
      return outcome;
    }
    if (stage_.until != Until::time && s_.time - s_.progress.start_time >= stage_.max_time) {
      outcome.reason = "stage.until = \"" + until +
                       "\" not met after stage.max_time = " + std::to_string(stage_.max_time) + unit + end_.missing() +
                       "; raise stage.max_time" + (waits ? " or set finish.method" : "");
      return outcome;
    }
    return std::nullopt;
  }

  void finish() {
    if (s_.scene.finish.method == Finish::drag && !s_.progress.drag_on) {
      s_.progress.drag_on = true;
      solver_->set_drag(s_.scene.finish.drag);
    }
    if (policy_.statically_solved()) settle();
  }

  // Static solves instead of waiting. When they meet a capture, the run goes through it and they take over again. If
  // they cannot do anything, nothing has changed: the run goes on and tries again later.
  void settle() {
    const auto control = cell_control(s_, stage_);
    const bool flying = policy_.still_flying();
    const double drag = policy_.rings() && !flying ? s_.scene.finish.drag : 0.0;
    const FinishingReport report =
        finisher_->settle(s_, {control.stress, control.inertia, drag, flying, hooks_.interrupted,
                               [this] { return observers_.checkpoint_due(); }, [this] { observers_.checkpoint(s_); }});
    if (report.interrupted) {
      interrupted_ = true;  // a resumed run comes here again, and goes on within the solve
      return;
    }
    if (report.settled || report.advanced) {
      ++s_.progress.solves;
      begin_again();
      s_.certificate.finishing = "newton";
    }
    s_.progress.drifting = policy_.drifts_after(report);
    certify();
    s_.certificate.moving = std::max(s_.certificate.moving, report.moving);
    policy_.wait_after(report);
  }

  State<System>& s_;
  const StageScene& stage_;
  const RunHooks<System>& hooks_;
  const SolverOptions options_;
  Observers<System>& observers_;
  StaticSolver<System>* finisher_;
  StageEnd<System> end_;
  FinishingPolicy<System> policy_;
  Outflow<System> outflow_;
  std::optional<Solver<System>> solver_;
  StepTimes times_before_;  // of the solvers before this one
  std::int64_t interval_, slice_;
  bool interrupted_ = false;  // in a static solve
};

}  // namespace isostat
