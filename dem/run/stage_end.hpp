// The ends of a stage: which of them is met, and what is missing. Read from a fresh snapshot with its certificate.
#pragma once
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "dem/run/outflow.hpp"
#include "dem/run/stage_opening.hpp"
#include "dem/state/certificate.hpp"
#include "dem/state/clusters.hpp"
#include "dem/state/state.hpp"

namespace isostat {

template <class System>
class StageEnd {
 public:
  StageEnd(State<System>& state, const StageScene& stage) : s_(state), stage_(stage), outflow_(state, stage) {}

  // [T0] when the stage is over by its length; infinite where that is no matter of time.
  double time() const { return stage_.until == Until::time ? s_.progress.start_time + stage_.time : INFINITY; }
  bool reached(double now) const { return now >= time() - 0.5 * s_.time_step; }

  bool met() const {
    switch (stage_.until) {
      case Until::equilibrium:
        return at_rest();
      case Until::aggregated:
        return at_rest() && count_clusters(s_.packing) == 1;
      case Until::time:
        return reached(s_.time);
      case Until::strain:
        return strain() >= stage_.strain;
      case Until::failure:
        return failed();
      case Until::empty:
        return outflow_.empty();
      case Until::clogged:
        return outflow_.clogged();
      case Until::separated:
        return event_met(s_, stage_);
    }
    return false;
  }

  // What keeps the stage from its end.
  std::string missing() const {
    switch (stage_.until) {
      case Until::strain:
        return "the strain is " + std::to_string(strain());
      case Until::failure:
        return "the stress carried, " + std::to_string(s_.progress.carried_stress) +
               ", has not lost the part stage.drop of its peak, " + std::to_string(s_.progress.peak_stress);
      case Until::empty:
      case Until::clogged:
        return outflow_.missing();
      case Until::separated:
        return event_missing(s_, stage_);
      case Until::time:
      case Until::equilibrium:
      case Until::aggregated:
        break;
    }
    if (law_changes(s_, stage_)) return "K_N is still changing";
    if (still_loading(s_, stage_)) return "stage.ramp_time is not over";
    if (s_.progress.drifting) return "floppy modes are still drifting";
    if (s_.certificate.equilibrated) return std::to_string(count_clusters(s_.packing)) + " clusters";
    const WorstCriterion worst = worst_criterion(s_.certificate);
    return worst.name + " is " + std::to_string(worst.ratio) + " times its tolerance";
  }

  // Why it can't be met any more, if so.
  std::optional<std::string> spoilt() const { return outflow_.spoilt(); }

  // At a look. What a shock adds for the time of a vibration is no strength, and what a vibration takes away for as
  // long is no loss; nor is a slip after which the packing carries on. So the stress is a mean over the time of the one
  // and a part of the test for the other.
  void follow_peak() {
    if (stage_.until != Until::failure) return;
    StageProgress<System::dimension>& p = s_.progress;
    const double since = s_.time - p.carried_at;
    const double memory =
        std::max(kPersistence * inertial_time(s_, acting_pressure(s_)), kPersistentPart * (s_.time - p.start_time));
    p.carried_stress += since / (memory + since) * (carried() - p.carried_stress);
    p.carried_at = s_.time;
    p.peak_stress = std::max(p.peak_stress, p.carried_stress);
  }

 private:
  static constexpr double kFailureNoise = 1e-3;    // [F1/a] a peak below is none
  static constexpr double kPersistence = 10;       // [sqrt(m a / F1)] about a period of the softest chains
  static constexpr double kPersistentPart = 0.05;  // [-] of the time since the stage began, at a rate: of its strain

  bool at_rest() const { return !still_loading(s_, stage_) && s_.certificate.equilibrated && !s_.progress.drifting; }
  // Of the driven directions, the largest.
  double strain() const {
    double largest = 0;
    for (int a = 0; a < System::dimension; ++a)
      if (stage_.driven(a))
        largest = std::max(largest, std::abs(1 - s_.packing.cell->length[a] / s_.cell_motion.reference_length[a]));
    if (stage_.shear_driven()) largest = std::max(largest, std::abs(s_.cell_motion.shear_strain));
    return largest;
  }
  // +1: the stage compresses along this direction, -1: it pulls, by a rate or else by a stress that changes; 0:
  // neither.
  int tested(int a) const {
    const auto sign = [](double x) { return (x > 0) - (x < 0); };
    const auto u = static_cast<std::size_t>(a);
    if (stage_.driven()) return sign(stage_.strain_rates()[u].value_or(0));
    const auto wanted = imposed_stress<System::dimension>(stage_)[u];
    return wanted ? sign(*wanted - s_.progress.ramp_stress[a]) : 0;
  }
  // The same of the shear strain -d(tilt)/L2.
  int shear_tested() const {
    const auto sign = [](double x) { return (x > 0) - (x < 0); };
    if (stage_.driven()) return -sign(stage_.shear_rate.value_or(0));
    return stage_.stress_12 ? sign(*stage_.stress_12 - s_.progress.ramp_shear_stress) : 0;
  }
  // [F0/a] What a tested direction carries more than the others, whose stress is imposed; the largest.
  double carried() const {
    double others = 0, largest = -INFINITY;
    int held = 0;
    for (int a = 0; a < System::dimension; ++a)
      if (const auto& imposed = s_.imposed_stress[static_cast<std::size_t>(a)]; imposed && tested(a) == 0)
        others += *imposed, ++held;
    const Vec<System::dimension> stress = static_stress(s_);
    for (int a = 0; a < System::dimension; ++a)
      if (const int sign = tested(a)) largest = std::max(largest, sign * (stress[a] - others / std::max(held, 1)));
    if (const int sign = shear_tested()) largest = std::max(largest, sign * static_shear_stress(s_));
    return largest;
  }
  bool failed() const {
    const StageProgress<System::dimension>& p = s_.progress;
    return p.peak_stress > kFailureNoise * s_.certificate.force_scale &&
           p.carried_stress < (1 - stage_.drop) * p.peak_stress;
  }

  State<System>& s_;
  const StageScene& stage_;
  Outflow<System> outflow_;
};

}  // namespace isostat
