#include "apps/interrupt.hpp"

#include <array>
#include <atomic>
#include <csignal>

namespace isostat {
namespace {

std::atomic<bool> asked{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set from a signal handler");

// SIGHUP: the terminal is closed; not where it is ignored, as under nohup.
constexpr std::array kSignals{SIGINT, SIGTERM, SIGHUP};

void handle(int signal) {
  if (asked.exchange(true)) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
}

}  // namespace

InterruptGuard::InterruptGuard() {
  asked = false;
  for (const int signal : kSignals)
    if (std::signal(signal, handle) == SIG_IGN && signal == SIGHUP) std::signal(signal, SIG_IGN);
}

InterruptGuard::~InterruptGuard() {
  for (const int signal : kSignals)
    if (std::signal(signal, SIG_DFL) == SIG_IGN) std::signal(signal, SIG_IGN);
}

bool InterruptGuard::requested() { return asked.load(std::memory_order_relaxed); }

}  // namespace isostat
