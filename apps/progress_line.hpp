// One line on a terminal that says how far a run is, which equilibrium criterion is missing, and when it may be met.
#pragma once
#include <mutex>
#include <string>

#include "dem/run/stages.hpp"

namespace isostat {

std::string clock_text(double seconds);                  // 02:35, 3h07; --:-- if not known
std::string time_text(double time, SceneSystem system);  // "t 12.5 T0", "t 0.1250 s"
std::string solid_fraction_text(double phi);             // "  Phi 0.8123"; nothing without a cell
// What the stage waits for: the criterion of equilibrium furthest from its tolerance, or an event.
std::string missing_text(const Progress& progress, const StageScene& stage);

class ProgressLine {
 public:
  ProgressLine(int stages, int samples);  // silent unless stderr is a terminal
  ~ProgressLine();                        // ends the line
  void update(const Progress& progress, const Scene& scene, int sample);
  void tell(const std::string& lines);  // on stderr, terminal or not, without the progress in the way

 private:
  double seconds_left(const Progress& progress, const StageScene& stage);
  int stages_, samples_;
  bool terminal_;
  double start_, last_shown_ = -1;              // [s]
  double first_log_ratio_ = 0, first_at_ = -1;  // where the decline of the last criterion is measured from
  double first_time_ = 0;
  int shown_stage_ = -1;
  std::mutex lock_;
};

}  // namespace isostat
