#include "apps/work_line.hpp"

#include <unistd.h>

#include <cstdio>

namespace isostat {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds kTick{500};  // nothing is shown of what takes less

}  // namespace

WorkLine::WorkLine() : terminal_(isatty(STDERR_FILENO) == 1), since_(Clock::now()) {
  if (terminal_) ticker_ = std::thread([this] { tick(); });
}

WorkLine::~WorkLine() {
  if (!terminal_) return;
  {
    const std::scoped_lock hold(lock_);
    stops_ = true;
  }
  wake_.notify_all();
  ticker_.join();
  if (shown_) std::fputs("\r\033[K", stderr);
}

void WorkLine::begins(const std::string& what) {
  const std::scoped_lock hold(lock_);
  what_ = what;
  since_ = Clock::now();
}

void WorkLine::tick() {
  std::unique_lock hold(lock_);
  while (!wake_.wait_for(hold, kTick, [this] { return stops_; })) {
    if (what_.empty()) continue;
    const double seconds = std::chrono::duration<double>(Clock::now() - since_).count();
    std::fprintf(stderr, "\r\033[K%s  %.0f s", what_.c_str(), seconds);
    std::fflush(stderr);
    shown_ = true;
  }
}

}  // namespace isostat
