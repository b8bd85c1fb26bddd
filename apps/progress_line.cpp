#include "apps/progress_line.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "dem/solver/clocks.hpp"

namespace isostat {
namespace {

constexpr double kRefresh = 0.2;       // [s]
constexpr double kTrendMemory = 10.0;  // [s] the decline is measured over the last so many seconds or more

}  // namespace

std::string clock_text(double seconds) {
  if (!(seconds >= 0) || seconds > 99 * 3600.0) return "--:--";
  const int s = static_cast<int>(std::lround(seconds));
  char text[32];
  if (s < 3600)
    std::snprintf(text, sizeof text, "%02d:%02d", s / 60, s % 60);
  else
    std::snprintf(text, sizeof text, "%dh%02d", s / 3600, s / 60 % 60);
  return text;
}

std::string time_text(double time, SceneSystem system) {
  char text[48];
  const bool disks = system == SceneSystem::disks;
  std::snprintf(text, sizeof text, disks ? "t %.1f %s" : "t %.4f %s", time, std::string(time_unit(system)).c_str());
  return text;
}

std::string solid_fraction_text(double phi) {
  char text[32];
  std::snprintf(text, sizeof text, "  Phi %.4f", phi);
  return std::isnan(phi) ? std::string() : text;
}

std::string missing_text(const Progress& p, const StageScene& stage) {
  if (ends_with_event(stage.until)) return "until " + std::string(name(stage.until));
  char text[96];
  std::snprintf(text, sizeof text, "%s %.3g x tolerance", p.last.name.c_str(), p.last.ratio);
  return text;
}

ProgressLine::ProgressLine(int stages, int samples)
    : stages_(stages), samples_(samples), terminal_(isatty(STDERR_FILENO) == 1), start_(wall_seconds()) {}

ProgressLine::~ProgressLine() {
  if (terminal_ && last_shown_ >= 0) std::fputc('\n', stderr);
}

// A timed stage: by proportion. Equilibrium: by the exponential decline of the criterion furthest from its tolerance.
// When an event comes nobody knows.
double ProgressLine::seconds_left(const Progress& p, const StageScene& stage) {
  const double t = wall_seconds();
  if (p.stage != shown_stage_)
    shown_stage_ = p.stage, first_at_ = t, first_time_ = p.time, first_log_ratio_ = std::log(p.last.ratio);
  if (stage.until == Until::time) {
    const double done = p.time - first_time_;
    return done > 0 ? (t - first_at_) * (stage.time - done) / done : NAN;
  }
  if (ends_with_event(stage.until)) return NAN;
  const double log_ratio = std::log(std::max(p.last.ratio, 1e-300));
  const double slope = (first_log_ratio_ - log_ratio) / (t - first_at_);
  const double left = slope > 0 ? std::max(0.0, log_ratio) / slope : NAN;
  if (t - first_at_ > 2 * kTrendMemory)
    first_at_ = t - kTrendMemory, first_log_ratio_ = log_ratio + slope * kTrendMemory;
  return left;
}

void ProgressLine::update(const Progress& p, const Scene& scene, int sample) {
  if (!terminal_) return;
  const std::scoped_lock hold(lock_);
  const double t = wall_seconds();
  if (t - last_shown_ < kRefresh) return;
  last_shown_ = t;
  const StageScene& stage = scene.stages[static_cast<std::size_t>(p.stage)];
  const double left = seconds_left(p, stage);
  std::string head;
  if (samples_ > 1) head = "sample " + std::to_string(sample + 1) + "/" + std::to_string(samples_) + "  ";
  std::fprintf(stderr, "\r\033[K%sstage %d/%d  %s%s  missing: %s  %s, ETA %s", head.c_str(), p.stage + 1, stages_,
               time_text(p.time, scene.system).c_str(), solid_fraction_text(p.solid_fraction).c_str(),
               missing_text(p, stage).c_str(), clock_text(t - start_).c_str(), clock_text(left).c_str());
  std::fflush(stderr);
}

void ProgressLine::tell(const std::string& lines) {
  const std::scoped_lock hold(lock_);
  std::fprintf(stderr, "%s%s", terminal_ && last_shown_ >= 0 ? "\r\033[K" : "", lines.c_str());
  std::fflush(stderr);
  last_shown_ = -1;
}

}  // namespace isostat
