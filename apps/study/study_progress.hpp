// How far the whole study is: a line on a terminal, or a line for each run that has ended.
#pragma once
#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace isostat {

class StudyProgress {
 public:
  // `work`: what each of the runs to be done may cost, in any unit; `done_before`: of `total` runs of the study.
  StudyProgress(std::vector<double> work, std::size_t total, std::size_t done_before, std::size_t at_a_time);
  ~StudyProgress();
  StudyProgress(const StudyProgress&) = delete;
  StudyProgress& operator=(const StudyProgress&) = delete;

  bool on_terminal() const { return terminal_; }
  void started(std::size_t task);
  void tells(std::size_t task, const std::string& name, const std::string& how_far);
  void ended(std::size_t task, const std::string& name, const std::string& how);  // always told
  void show();

 private:
  double seconds_left() const;
  void clear_line() const;

  std::vector<double> work_;
  std::size_t total_, done_, at_a_time_;
  bool terminal_;
  double start_;                           // [s]
  std::map<std::size_t, double> at_work_;  // since when [s]
  double work_done_ = 0, seconds_done_ = 0;
  std::string last_told_;
};

}  // namespace isostat
