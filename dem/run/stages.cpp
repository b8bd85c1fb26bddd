#include "dem/run/stages.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <numbers>

#include "dem/input_error.hpp"
#include "dem/disks/certificate.hpp"
#include "dem/run/stage_opening.hpp"
#include "dem/state/clusters.hpp"
#include "dem/state/contact_set.hpp"

namespace isostat {
namespace {

double solid_fraction(const Bodies<2>& b, const PeriodicCell<2>& cell) {
  double area = 0;
  for (double r : b.radius) area += std::numbers::pi * r * r;
  return area / cell.measure();
}

// Of the calling thread, or with a team of threads of the process.
double cpu_seconds(int threads) {
  timespec t{};
  clock_gettime(threads == 1 ? CLOCK_THREAD_CPUTIME_ID : CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

// Contacts that carry a force, or with cohesion all of them. Without it the contacts of rattlers come and go.
std::size_t loaded_contacts(const State& s) {
  return static_cast<std::size_t>(std::count_if(s.packing.links.begin(), s.packing.links.end(), [&s](const Link<2>& l) {
    return is_contact(l.kind) && (s.law.attraction > 0 || l.normal_force > kLoadTolerance * s.certificate.force_scale);
  }));
}

constexpr double kCarried = 0.5;  // [-] of the imposed stress that may be missing when finishing begins
constexpr double kRinging = 20;   // [-] times the kinetic tolerance: static solves follow what still moves
constexpr double kFlying = 100;   // [-] and the last clusters on their long flights to each other
constexpr double kCapture = 2;    // [T0] that a capture is followed before static solves are tried again
constexpr double kWait = 0.1;     // [-] of the time since the start of the stage, after a static solve that failed
constexpr double kNetwork = 0.9;  // [links a grain] a connected network has one at least; rattlers have none

// Steps between two looks at the packing: half a T0, within reason. A look costs about as much as ten steps.
std::int64_t check_interval(double time_step) {
  return std::clamp<std::int64_t>(static_cast<std::int64_t>(std::lround(0.5 / time_step)), 200, 2000);
}

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

constexpr std::int64_t kStiffenEvery = 10;  // [steps] K_N changes by 1e-4 or so each time
constexpr double kFailureNoise = 1e-3;      // [F1/a] changes of stress below are no peak

constexpr std::int64_t kGrainStepsPerSlice = 10'000'000;  // about a tenth of a second between polls

// One stage from wherever it stands to its end.
class StageRun {
 public:
  StageRun(State& state, const SolverOptions& options, const RunHooks& hooks, StaticSolver* finisher)
      : s_(state),
        stage_(state.scene.stages[static_cast<std::size_t>(state.progress.stage)]),
        hooks_(hooks),
        options_(options),
        finisher_(finisher),
        solver_(std::in_place, state, cell_control(state, stage_), options),
        interval_(check_interval(state.time_step)),
        slice_(std::max<std::int64_t>(1, kGrainStepsPerSlice / static_cast<std::int64_t>(state.packing.bodies.size()))),
        last_checkpoint_(wall_seconds()) {
    if (s_.progress.drag_on) solver_->set_drag(s_.scene.finish.drag);
    if (hooks_.observe_interval > 0)
      last_observation_ = std::floor((s_.time + 0.5 * s_.time_step) / hooks_.observe_interval);
    solid_fraction_before_ = solid_fraction(s_.packing.bodies, solver_->cell());
  }

  // True when the stage is over; false when it was interrupted.
  bool run(StageOutcome& outcome) {
    for (;;) {
      if (solver_->steps() % interval_ == 0 || at_end()) {
        look();
        const bool to_be_solved = statically_solved() && end_met();
        if (!to_be_solved && over(outcome)) return true;
        if (s_.scene.finish.method != Finish::none) {
          follow_contacts();
          if (to_be_solved || only_creep_is_left()) finish();
          if (!interrupted_ && over(outcome)) return true;
        }
      }
      if (interrupted_ || (hooks_.interrupted && hooks_.interrupted())) {
        solver_->snapshot(s_);
        certify();
        return false;
      }
      stiffen();
      solver_->run(steps_to_next_stop());
      observe();
    }
  }
  StepTimes times() const {
    StepTimes sum = times_before_;
    return sum += solver_->times();
  }

 private:
  double end_time() const { return stage_.until == "time" ? s_.progress.start_time + stage_.time : INFINITY; }
  bool at_end() const { return solver_->time() >= end_time() - 0.5 * s_.time_step; }
  bool waits_for_equilibrium() const { return stage_.until == "equilibrium" || stage_.until == "aggregated"; }
  // Static solves have the last word: the criteria may hold while a soft mode passes through its turning point.
  bool statically_solved() const {
    return s_.scene.finish.method == Finish::newton && waits_for_equilibrium() && !driven(0) && !driven(1);
  }

  bool stiffening() const { return stage_.normal_stiffness && s_.law.normal_stiffness != *stage_.normal_stiffness; }
  // K_N on its way from what it was to what the stage wants, as a function of time alone.
  void stiffen() {
    if (!stiffening() || solver_->steps() % kStiffenEvery != 0) return;
    const double from = s_.progress.start_stiffness, to = *stage_.normal_stiffness;
    const double part = (solver_->time() - s_.progress.start_time) / stage_.stiffening_time;
    LawScene law = s_.scene.law;
    law.normal_stiffness = part < 1 ? from * std::pow(to / from, part) : to;
    s_.law = resolve(law);
    solver_->set_law(s_.law,
                     stage_.stiffening_keeps == "elongations" ? Springs::keep_elongations : Springs::keep_forces);
  }

  std::int64_t steps_to_next_stop() const {
    std::int64_t steps = std::min(slice_, interval_ - solver_->steps() % interval_);
    double stop = end_time();
    if (hooks_.observe && hooks_.observe_interval > 0)
      stop = std::min(stop, (last_observation_ + 1) * hooks_.observe_interval);
    if (hooks_.snapshot)
      for (double t : s_.scene.output.snapshot_times)
        if (t > solver_->time() + 0.5 * s_.time_step) stop = std::min(stop, t);
    if (stiffening()) steps = std::min(steps, kStiffenEvery - solver_->steps() % kStiffenEvery);
    if (std::isfinite(stop))
      steps = std::clamp<std::int64_t>(std::llround((stop - solver_->time()) / s_.time_step), 1, steps);
    return steps;
  }

  // Observers, at whatever step they ask for.
  void observe() {
    const double half = 0.5 * s_.time_step;
    if (hooks_.observe && hooks_.observe_interval > 0 &&
        solver_->time() + half >= (last_observation_ + 1) * hooks_.observe_interval) {
      last_observation_ = std::floor((solver_->time() + half) / hooks_.observe_interval);
      solver_->check_sanity();
      solver_->snapshot(s_);
      certify();
      hooks_.observe(s_);
    }
    if (hooks_.snapshot) {
      const double now = solid_fraction(s_.packing.bodies, solver_->cell());
      bool wanted = false;
      for (double phi : s_.scene.output.snapshot_solid_fractions)
        wanted = wanted || (phi - solid_fraction_before_) * (phi - now) <= 0;
      for (double t : s_.scene.output.snapshot_times) wanted = wanted || std::abs(t - solver_->time()) <= half;
      solid_fraction_before_ = now;
      if (wanted) {
        solver_->check_sanity();
        solver_->snapshot(s_);
        certify();
        hooks_.snapshot(s_);
      }
    }
  }

  void certify() {
    const std::string finishing = s_.progress.drag_on ? "drag" : s_.certificate.finishing;
    s_.certificate = evaluate_certificate(s_.packing, s_.law, s_.imposed_stress, s_.scene.equilibrium);
    s_.certificate.finishing = finishing;
  }

  void look() {
    solver_->check_sanity();
    solver_->snapshot(s_);
    certify();
    if (hooks_.progress)
      hooks_.progress({s_.progress.stage, s_.time, solid_fraction(s_.packing.bodies, *s_.packing.cell),
                       worst_criterion(s_.certificate), &s_.certificate});
    if (hooks_.checkpoint && hooks_.checkpoint_seconds > 0 &&
        wall_seconds() - last_checkpoint_ > hooks_.checkpoint_seconds) {
      hooks_.checkpoint(s_);
      last_checkpoint_ = wall_seconds();
    }
  }

  bool driven(int direction) const {
    return (direction == 0 ? stage_.strain_rate_1 : stage_.strain_rate_2).value_or(0) != 0;
  }
  double strain() const {
    double largest = 0;
    for (int a = 0; a < 2; ++a)
      if (driven(a))
        largest = std::max(largest, std::abs(1 - solver_->cell().length[a] / s_.cell_motion.reference_length[a]));
    return largest;
  }
  // Change of the stress of the driven directions since the stage began [F0/a].
  double stress_change() const {
    const Vec2 change = static_stress(s_) - s_.progress.start_stress;
    return std::max(driven(0) ? std::abs(change[0]) : 0.0, driven(1) ? std::abs(change[1]) : 0.0);
  }
  void follow_peak() {
    if (stage_.until == "failure") s_.progress.peak_stress = std::max(s_.progress.peak_stress, stress_change());
  }
  bool failed() const {
    const double peak = s_.progress.peak_stress;
    return peak > kFailureNoise * s_.certificate.force_scale && stress_change() < (1 - stage_.drop) * peak;
  }

  bool end_met() const {
    if (stage_.until == "time") return at_end();
    if (stage_.until == "strain") return strain() >= stage_.strain;
    if (stage_.until == "failure") return failed();
    return !stiffening() && s_.certificate.equilibrated && !s_.progress.drifting &&
           (stage_.until != "aggregated" || count_clusters(s_.packing) == 1);
  }
  // What keeps the stage from its end.
  std::string missing() const {
    if (stage_.until == "strain") return "the strain is " + std::to_string(strain());
    if (stage_.until == "failure") return "the peak stress has not dropped by stage.drop";
    if (stiffening()) return "K_N is still changing";
    if (s_.progress.drifting) return "floppy modes are still drifting";
    if (s_.certificate.equilibrated) return std::to_string(count_clusters(s_.packing)) + " clusters";
    const WorstCriterion worst = worst_criterion(s_.certificate);
    return worst.name + " is " + std::to_string(worst.ratio) + " times its tolerance";
  }

  // Everything that is decided about a run is decided here, at fixed steps, whoever watches.
  bool over(StageOutcome& outcome) {
    follow_peak();
    outcome = {s_.progress.stage, true, s_.time, stage_.until, waits_for_equilibrium() ? s_.certificate.moving : 0};
    if (end_met()) return true;
    outcome.met = false;
    if (hooks_.max_time > 0 && s_.time >= hooks_.max_time) {
      outcome.reason = "stopped by --max-time " + std::to_string(hooks_.max_time) + " T0: " + missing();
      return true;
    }
    if (stage_.until != "time" && s_.time - s_.progress.start_time >= stage_.max_time) {
      outcome.reason = "stage.until = \"" + stage_.until +
                       "\" not met after stage.max_time = " + std::to_string(stage_.max_time) + " T0: " + missing() +
                       "; raise stage.max_time" + (waits_for_equilibrium() ? " or set finish.method" : "");
      return true;
    }
    return false;
  }

  void follow_contacts() {
    const std::uint64_t now = contact_set(s_);
    if (now != s_.progress.contact_set || stiffening())
      s_.progress.contact_set = now, s_.progress.unchanged_since = s_.time;
  }

  bool still_flying() const { return stage_.until == "aggregated" && count_clusters(s_.packing) > 1; }
  // What still moves has changed no contact for long.
  bool rings() const { return s_.time - s_.progress.unchanged_since >= s_.scene.finish.unchanged_time; }

  // Only creep is left when there is a network (as many loaded contacts as grains), it carries most of the imposed
  // stress, and the kinetic criterion (static solves: a multiple of it) has been met for finish.quiet_time. To finish
  // earlier would stop the very motions that make the packing: when a compression begins nothing moves fast either.
  // Static solves follow a ringing cell as well, whose stress passes through the imposed one again and again: for them
  // the network need carry it only at the instant they begin.
  bool only_creep_is_left() {
    const Certificate& c = s_.certificate;
    const bool newton = s_.scene.finish.method == Finish::newton;
    const bool network =
        waits_for_equilibrium() && !stiffening() && (newton || !still_flying()) &&
        static_cast<double>(loaded_contacts(s_)) >= kNetwork * static_cast<double>(s_.packing.bodies.size());
    const bool carries =
        c.pressure_error * c.force_scale < std::max(kCarried * std::abs(largest_stress(s_.imposed_stress).value_or(0)),
                                                    10 * c.tolerance_pressure * c.force_scale);
    const double most = !newton ? 1.0 : stage_.until == "aggregated" ? kFlying : kRinging;
    const bool still = c.kinetic_energy_per_grain < most * c.tolerance_kinetic;
    double& since = s_.progress.quiet_since;
    if (!network || !still || !(carries || newton)) since = std::max(since, s_.time);
    return carries && ((network && rings()) || s_.time - since >= s_.scene.finish.quiet_time);
  }

  void finish() {
    if (s_.scene.finish.method == Finish::drag && !s_.progress.drag_on) {
      s_.progress.drag_on = true;
      solver_->set_drag(s_.scene.finish.drag);
    }
    if (statically_solved()) settle();
  }

  // Static solves instead of waiting. When they meet a capture, the run goes through it and they take over again. If
  // they cannot do anything, nothing has changed: the run goes on and tries again after a time that grows with that of
  // the stage.
  void settle() {
    const CellControl control = cell_control(s_, stage_);
    const FinishingReport report =
        finisher_->settle(s_, {control.stress, control.inertia, rings() && !still_flying() ? s_.scene.finish.drag : 0.0,
                               still_flying(), hooks_.interrupted});
    if (report.interrupted) {
      interrupted_ = true;  // nothing has changed: a resumed run begins the same solve
      return;
    }
    if (report.settled || report.advanced) {
      times_before_ += solver_->times();
      solver_.emplace(s_, control, options_);
      solver_->snapshot(s_);
      s_.certificate.finishing = "newton";
    }
    // Vibrations are silent now, so that the kinetic criterion alone would end the stage; but floppy modes are on their
    // way to a contact. When nothing can be done about them the criteria alone decide, and the certificate says so.
    s_.progress.drifting = report.moving == 0 && (report.advanced || (s_.progress.drifting && report.capture));
    certify();
    s_.certificate.moving = std::max(s_.certificate.moving, report.moving);
    const double later = s_.time + kWait * (s_.time - s_.progress.start_time);
    s_.progress.quiet_since =
        (report.capture || report.advanced) && !report.stuck ? s_.time + kCapture - s_.scene.finish.quiet_time : later;
    s_.progress.unchanged_since = std::max(s_.progress.unchanged_since, later - s_.scene.finish.unchanged_time);
  }

  State& s_;
  const StageScene& stage_;
  const RunHooks& hooks_;
  const SolverOptions options_;
  StaticSolver* finisher_;
  std::optional<Solver> solver_;
  StepTimes times_before_;  // of the solvers before a static solve
  std::int64_t interval_, slice_;
  double last_observation_ = 0;  // [observe_interval]
  double solid_fraction_before_ = 0;
  double last_checkpoint_;
  bool interrupted_ = false;  // in a static solve
};

}  // namespace

bool RunOutcome::all_met() const {
  return std::all_of(stages.begin(), stages.end(), [](const StageOutcome& s) { return s.met; });
}

RunOutcome run_stages(State& state, const SolverOptions& options, const RunHooks& hooks, StaticSolver* finisher) {
  if (state.scene.finish.method == Finish::newton && !finisher)
    throw InputError("scene", 0, "finish.method", "newton", "needs a static solver, and this program brings none");
  RunOutcome outcome;
  const double wall_start = wall_seconds(), cpu_start = cpu_seconds(options.threads);
  const auto stages = static_cast<std::int32_t>(state.scene.stages.size());
  const std::int64_t first_step = state.step;
  while (state.progress.stage < stages) {
    if (!state.progress.started) open_stage(state, state.scene.stages[static_cast<std::size_t>(state.progress.stage)]);
    StageRun run(state, options, hooks, finisher);
    StageOutcome stage;
    outcome.interrupted = !run.run(stage);
    outcome.times += run.times();
    if (outcome.interrupted) break;
    outcome.stages.push_back(stage);
    ++state.progress.stage;
    state.progress.started = false;
    if (hooks.stage_end) hooks.stage_end(state);
    if (hooks.max_time > 0 && state.time >= hooks.max_time) break;
  }
  outcome.steps = state.step - first_step;
  outcome.wall_seconds = wall_seconds() - wall_start;
  outcome.cpu_seconds = cpu_seconds(options.threads) - cpu_start;
  return outcome;
}

}  // namespace isostat
