// Numbered tasks, a process each, so many at a time. A task that crashes takes no other with it, and one that is slow
// keeps only its own place.
#pragma once
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace isostat {

// Inside a task's process. Ctrl-C and hang-ups reach the parent only, which then asks its tasks to stop; they are asked
// too if the parent dies in whatever way.
class TaskLink {
 public:
  static bool stop_requested();
  static void send(const std::string& line);  // to the parent; no line break inside
  // Code that may be cut short: when a stop is requested the process ends.
  static void may_be_cut_short();
};

struct PoolWatch {
  std::function<bool()> stop;  // polled; true: start no more tasks and ask those at work to stop
  std::function<void(std::size_t task, const std::string& line)> line;
  // `code` is what the task returned, or minus the signal that ended it.
  std::function<void(std::size_t task)> started;
  std::function<void(std::size_t task, int code)> ended;
  std::function<void()> tick;  // a few times a second
};

// Starts the tasks in this order; returns when all that were started have ended. An exception out of a task is sent as
// the line "error: ..." and code 4. Call from a process with one thread. Throws std::system_error if the system makes
// no process or pipe.
void run_in_processes(const std::vector<std::size_t>& tasks, std::size_t at_a_time,
                      const std::function<int(std::size_t)>& task, const PoolWatch& watch);

}  // namespace isostat
