// What a long command is at, and for how long, on a terminal: a line that goes when the work is done.
#pragma once
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace isostat {

class WorkLine {
 public:
  WorkLine();   // silent unless stderr is a terminal
  ~WorkLine();  // takes the line away
  WorkLine(const WorkLine&) = delete;
  WorkLine& operator=(const WorkLine&) = delete;
  void begins(const std::string& what);

 private:
  void tick();

  bool terminal_, stops_ = false, shown_ = false;
  std::string what_;
  std::chrono::steady_clock::time_point since_;
  std::mutex lock_;
  std::condition_variable wake_;
  std::thread ticker_;
};

}  // namespace isostat
