// Who looks at a run and when: series, snapshots, checkpoints. They live as long as the run, with one clock for its
// checkpoints. Nothing here changes the run.
#pragma once
#include <algorithm>
#include <cmath>

#include "dem/run/stages.hpp"
#include "dem/solver/clocks.hpp"
#include "dem/state/solid_fraction.hpp"

namespace isostat {

template <class System>
class Observers {
 public:
  using Cell = std::optional<PeriodicCell<System::dimension>>;

  explicit Observers(const RunHooks<System>& hooks) : hooks_(hooks), last_checkpoint_(wall_seconds()) {}

  void begin_stage(const State<System>& s) {
    half_step_ = 0.5 * s.time_step;
    if (observes()) last_observation_ = std::floor((s.time + half_step_) / hooks_.observe_interval);
    if (const auto interval = s.scene.output.snapshot_interval)
      last_snapshot_ = std::floor((s.time + half_step_) / *interval);
    solid_fraction_before_ = solid_fraction(s.packing);
  }

  // [T0] the next time at which somebody wants to look; infinite: nobody does.
  double next_time(const State<System>& s, double now) const {
    double next = observes() ? next_observation() : INFINITY;
    if (!hooks_.snapshot) return next;
    const OutputScene& o = s.scene.output;
    if (o.snapshot_interval) next = std::min(next, (last_snapshot_ + 1) * *o.snapshot_interval);
    for (const double t : o.snapshot_times)
      if (t > now + half_step_) next = std::min(next, t);
    return next;
  }

  // Calls them if it is time; take() brings the state up to this instant.
  template <class Take>
  void watch(State<System>& s, double now, const Cell& cell, Take&& take) {
    if (observes() && now + half_step_ >= next_observation()) {
      last_observation_ = std::floor((now + half_step_) / hooks_.observe_interval);
      take();
      hooks_.observe(s);
    }
    if (hooks_.snapshot && snapshot_wanted(s, now, cell)) {
      take();
      hooks_.snapshot(s);
    }
  }

  // At every look at the packing, with a fresh state and its certificate.
  void look(const State<System>& s) {
    if (hooks_.progress)
      hooks_.progress(
          {s.progress.stage, s.time, solid_fraction(s.packing), worst_criterion(s.certificate), &s.certificate});
    if (checkpoint_due()) checkpoint(s);
  }

  // Also at the end of a stage, and within a static solve.
  bool checkpoint_due() const {
    return hooks_.checkpoint && hooks_.checkpoint_seconds > 0 &&
           wall_seconds() - last_checkpoint_ > hooks_.checkpoint_seconds;
  }
  void checkpoint(const State<System>& s) {
    hooks_.checkpoint(s);
    last_checkpoint_ = wall_seconds();
  }

 private:
  bool observes() const { return hooks_.observe && hooks_.observe_interval > 0; }
  double next_observation() const { return (last_observation_ + 1) * hooks_.observe_interval; }

  bool snapshot_wanted(const State<System>& s, double now, const Cell& cell) {
    const double phi_now = solid_fraction(s.packing, cell), before = solid_fraction_before_;
    solid_fraction_before_ = phi_now;
    const auto crossed = [&](double phi) { return (phi - before) * (phi - phi_now) <= 0; };
    const auto due = [&](double t) { return std::abs(t - now) <= half_step_; };
    const OutputScene& o = s.scene.output;
    if (o.snapshot_interval && now + half_step_ >= (last_snapshot_ + 1) * *o.snapshot_interval) {
      last_snapshot_ = std::floor((now + half_step_) / *o.snapshot_interval);
      return true;
    }
    return std::any_of(o.snapshot_solid_fractions.begin(), o.snapshot_solid_fractions.end(), crossed) ||
           std::any_of(o.snapshot_times.begin(), o.snapshot_times.end(), due);
  }

  const RunHooks<System>& hooks_;
  double last_checkpoint_;       // [s]
  double half_step_ = 0;         // [T0]
  double last_observation_ = 0;  // [observe_interval]
  double last_snapshot_ = 0;     // [snapshot_interval]
  double solid_fraction_before_ = 0;
};

}  // namespace isostat
