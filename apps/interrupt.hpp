// Ctrl-C, SIGTERM and SIGHUP (the terminal is closed) ask for a stop; the run polls and stops resumably. A second one
// ends the program at once.
#pragma once

namespace isostat {

class InterruptGuard {
 public:
  InterruptGuard();   // installs the handlers
  ~InterruptGuard();  // puts the old ones back
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;
  static bool requested();
};

}  // namespace isostat
