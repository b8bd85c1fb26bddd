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
        return "the peak stress has not dropped by stage.drop";
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
    if (s_.progress.drifting) return "floppy modes are still drifting";
    if (s_.certificate.equilibrated) return std::to_string(count_clusters(s_.packing)) + " clusters";
    const WorstCriterion worst = worst_criterion(s_.certificate);
    return worst.name + " is " + std::to_string(worst.ratio) + " times its tolerance";
  }

  // Why it can't be met any more, if so.
  std::optional<std::string> spoilt() const { return outflow_.spoilt(); }

  void follow_peak() {
    if (stage_.until == Until::failure) s_.progress.peak_stress = std::max(s_.progress.peak_stress, stress_change());
  }

 private:
  static constexpr double kFailureNoise = 1e-3;  // [F1/a] changes of stress below are no peak

  bool at_rest() const { return !law_changes(s_, stage_) && s_.certificate.equilibrated && !s_.progress.drifting; }
  // Of the driven directions, the largest.
  double strain() const {
    double largest = 0;
    for (int a = 0; a < System::dimension; ++a)
      if (stage_.driven(a))
        largest = std::max(largest, std::abs(1 - s_.packing.cell->length[a] / s_.cell_motion.reference_length[a]));
    if (stage_.shear_driven()) largest = std::max(largest, std::abs(s_.cell_motion.shear_strain));
    return largest;
  }
  // Change of the stress of the driven directions since the stage began [F0/a].
  double stress_change() const {
    const Vec<System::dimension> change = static_stress(s_) - s_.progress.start_stress;
    double largest = 0;
    for (int a = 0; a < System::dimension; ++a)
      if (stage_.driven(a)) largest = std::max(largest, std::abs(change[a]));
    if (stage_.shear_driven())
      largest = std::max(largest, std::abs(static_shear_stress(s_) - s_.progress.start_shear_stress));
    return largest;
  }
  bool failed() const {
    const double peak = s_.progress.peak_stress;
    return peak > kFailureNoise * s_.certificate.force_scale && stress_change() < (1 - stage_.drop) * peak;
  }

  State<System>& s_;
  const StageScene& stage_;
  Outflow<System> outflow_;
};

}  // namespace isostat
