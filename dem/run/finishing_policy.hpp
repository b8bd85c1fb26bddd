// When a stage that only creeps is finished by other means than the bare law, and what a static solve leaves behind in
// the progress of the stage. The words capture, drift and flying are in docs/glossary.md.
//
// What StageProgress says between two looks:
//   quiet_since      since when there has been a network that hardly moves; pushed on while there is none
//   unchanged_since  since when the contacts have been the same; pushed on by each change
//   drifting         static solves have silenced the vibrations, but floppy modes are on their way to a contact
#pragma once
#include <algorithm>
#include <cmath>

#include "dem/run/finishing.hpp"
#include "dem/run/loading.hpp"
#include "dem/state/clusters.hpp"
#include "dem/state/contact_set.hpp"
#include "dem/state/state.hpp"

namespace isostat {

template <class System>
class FinishingPolicy {
 public:
  FinishingPolicy(State<System>& state, const StageScene& stage) : s_(state), stage_(stage) {}

  bool acts() const { return method() != Finish::none; }
  // Static solves have the last word: the criteria may hold while a soft mode passes through its turning point.
  bool statically_solved() const {
    return method() == Finish::newton && waits_for_equilibrium(stage_.until) && !stage_.driven();
  }

  void follow_contacts() {
    const std::uint64_t now = contact_set(s_.packing);
    if (now != s_.progress.contact_set || still_loading(s_, stage_))
      s_.progress.contact_set = now, s_.progress.unchanged_since = s_.time;
  }

  // Clusters still fly towards each other.
  bool still_flying() const { return stage_.until == Until::aggregated && count_clusters(s_.packing) > 1; }
  // What still moves has changed no contact for long.
  bool rings() const { return s_.time - s_.progress.unchanged_since >= s_.scene.finish.unchanged_time; }

  // Only creep is left when there is a network (as many loaded contacts as grains), it carries most of the imposed
  // stress, and the kinetic criterion (static solves: a multiple of it) has been met for finish.quiet_time. To finish
  // earlier would stop the very motions that make the packing: when a compression begins nothing moves fast either.
  // Static solves follow a ringing cell as well, whose stress passes through the imposed one again and again: for them
  // the network need carry it only at the instant they begin.
  bool only_creep_is_left() {
    const Certificate& c = s_.certificate;
    const bool newton = method() == Finish::newton;
    const bool network = waits_for_equilibrium(stage_.until) && !still_loading(s_, stage_) &&
                         (newton || !still_flying()) && has_network(s_);
    const bool carries =
        c.pressure_error * c.force_scale < std::max(kCarried * std::abs(largest_stress(s_.imposed_stress).value_or(0)),
                                                    10 * c.tolerance_pressure * c.force_scale);
    const double most = !newton ? 1.0 : stage_.until == Until::aggregated ? kFlying : kRinging;
    const bool still = c.kinetic_energy_per_grain < most * c.tolerance_kinetic;
    double& since = s_.progress.quiet_since;
    if (!network || !still || !(carries || newton)) since = std::max(since, s_.time);
    return carries && ((network && rings()) || s_.time - since >= s_.scene.finish.quiet_time);
  }

  // Vibrations are silent after a static solve, so that the kinetic criterion alone would end the stage; but floppy
  // modes are on their way to a contact. When nothing can be done about them the criteria alone decide, and the
  // certificate says so.
  bool drifts_after(const FinishingReport& report) const {
    return report.moving == 0 && (report.advanced || (s_.progress.drifting && report.capture));
  }

  // The next try: soon after a capture that the run goes through, else after a time that grows with that of the stage.
  void wait_after(const FinishingReport& report) {
    const FinishScene& f = s_.scene.finish;
    const double later = s_.time + kWait * (s_.time - s_.progress.start_time);
    const bool goes_through = (report.capture || report.advanced) && !report.stuck;
    s_.progress.quiet_since = goes_through ? s_.time + kCapture - f.quiet_time : later;
    s_.progress.unchanged_since = std::max(s_.progress.unchanged_since, later - f.unchanged_time);
  }

 private:
  static constexpr double kCarried = 0.5;  // [-] of the imposed stress that may be missing when finishing begins
  static constexpr double kRinging = 20;   // [-] times the kinetic tolerance: static solves follow what still moves
  static constexpr double kFlying = 100;   // [-] and the last clusters on their long flights to each other
  static constexpr double kCapture = 2;    // [T0] that a capture is followed before static solves are tried again
  static constexpr double kWait = 0.1;     // [-] of the time since the start of the stage, after a failed solve

  Finish method() const { return s_.scene.finish.method; }

  State<System>& s_;
  const StageScene& stage_;
};

}  // namespace isostat
