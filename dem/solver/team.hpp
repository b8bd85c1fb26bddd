// A team of threads that runs numbered tasks and waits for all of them. Which thread runs which task never enters a
// result: tasks write to disjoint places, and sums over tasks are made in the order of their numbers.
#pragma once
#include <functional>
#include <memory>

namespace isostat {

class Team {
 public:
  explicit Team(int threads);  // >= 1; one thread runs everything in the caller
  ~Team();
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  int threads() const { return threads_; }

  // task(k) for k in [0, count); returns when all are done. The first exception is rethrown.
  template <class Task>
  void run(int count, Task&& task) {
    if (threads_ == 1 || count <= 1) {
      for (int k = 0; k < count; ++k) task(k);
    } else {
      run_parallel(count, std::ref(task));
    }
  }

 private:
  void run_parallel(int count, const std::function<void(int)>& task);
  struct Crew;
  int threads_;
  std::unique_ptr<Crew> crew_;
};

}  // namespace isostat
