#include "apps/study/study_progress.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "apps/progress_line.hpp"
#include "dem/solver/clocks.hpp"

namespace isostat {
namespace {

constexpr double kMostOfARun = 0.95;  // a run that takes longer than expected counts as done to so much

}  // namespace

StudyProgress::StudyProgress(std::vector<double> work, std::size_t total, std::size_t done_before,
                             std::size_t at_a_time)
    : work_(std::move(work)),
      total_(total),
      done_(done_before),
      at_a_time_(at_a_time),
      terminal_(isatty(STDERR_FILENO) == 1),
      start_(wall_seconds()) {}

StudyProgress::~StudyProgress() { clear_line(); }

void StudyProgress::clear_line() const {
  if (terminal_) std::fputs("\r\033[K", stderr);
}

void StudyProgress::started(std::size_t task) { at_work_[task] = wall_seconds(); }

void StudyProgress::tells(std::size_t, const std::string& name, const std::string& how_far) {
  last_told_ = name + ": " + how_far;
}

void StudyProgress::ended(std::size_t task, const std::string& name, const std::string& how) {
  const double seconds = wall_seconds() - at_work_[task];
  at_work_.erase(task);
  work_done_ += work_[task];
  seconds_done_ += seconds;
  ++done_;
  clear_line();
  std::fprintf(stderr, "[%zu/%zu] %s: %s, %s\n", done_, total_, name.c_str(), how.c_str(), clock_text(seconds).c_str());
}

// By the speed of the runs that have ended; nothing can be said before the first has.
double StudyProgress::seconds_left() const {
  if (!(work_done_ > 0)) return NAN;
  const double speed = work_done_ / seconds_done_;  // of one place
  double left = -work_done_;
  for (const double w : work_) left += w;
  for (const auto& [task, since] : at_work_)
    left -= std::min(kMostOfARun * work_[task], speed * (wall_seconds() - since));
  const std::size_t places = std::clamp<std::size_t>(total_ - done_, 1, at_a_time_);
  return left / (speed * static_cast<double>(places));
}

void StudyProgress::show() {
  if (!terminal_) return;
  std::string line = std::to_string(done_) + " of " + std::to_string(total_) + " runs done, " +
                     std::to_string(at_work_.size()) + " at work  " + clock_text(wall_seconds() - start_) + ", ETA " +
                     clock_text(seconds_left()) + "  " + last_told_;
  winsize window{};
  if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &window) == 0 && window.ws_col > 1 && line.size() >= window.ws_col)
    line.resize(window.ws_col - 1u);  // a line that wraps could not be written over
  std::fprintf(stderr, "\r\033[K%s", line.c_str());
  std::fflush(stderr);
}

}  // namespace isostat
