// The program started beside the test, watched without polling: what it writes into a folder is heard of by inotify,
// its end by a pidfd. Nothing waits for ever.
#pragma once
#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/inotify.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <optional>
#include <string>
#include <thread>

namespace isostat {

constexpr std::chrono::seconds kLongEnough{100};  // for anything that a test waits for

class Child {
 public:
  // A command line of a shell, and the folder whose changes wake wait_for(); it may appear later, as may its files.
  Child(const std::string& command, std::string folder) : folder_(std::move(folder)), pid_(::fork()) {
    if (pid_ == 0) {
      ::execl("/bin/sh", "sh", "-c", ("exec " + command).c_str(), nullptr);
      ::_exit(99);
    }
    end_ = static_cast<int>(::syscall(SYS_pidfd_open, pid_, 0));
    changes_ = ::inotify_init1(IN_CLOEXEC | IN_NONBLOCK);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    if (!status_) ::kill(pid_, SIGKILL), reap();
    if (end_ >= 0) ::close(end_);
    if (changes_ >= 0) ::close(changes_);
  }

  // Until the condition holds: true; false if the program ended before, or nothing came of it.
  template <class Condition>
  bool wait_for(const Condition& condition) {
    const auto deadline = std::chrono::steady_clock::now() + kLongEnough;
    while (!condition()) {
      if (ended() || std::chrono::steady_clock::now() > deadline) return condition();
      const bool watched =
          ::inotify_add_watch(changes_, folder_.c_str(), IN_MODIFY | IN_CREATE | IN_MOVED_TO | IN_CLOSE_WRITE) >= 0;
      pollfd wake[] = {{end_, POLLIN, 0}, {changes_, POLLIN, 0}};
      ::poll(wake, 2, watched ? kRecheck : kUntilThere);
      char events[4096];
      while (::read(changes_, events, sizeof events) > 0) continue;
    }
    return true;
  }

  // The status of waitpid after the signal.
  int end_by(int signal) {
    if (!ended()) ::kill(pid_, signal);
    pollfd wake{end_, POLLIN, 0};
    if (::poll(&wake, 1, static_cast<int>(std::chrono::milliseconds(kLongEnough).count())) == 0) {
      ADD_FAILURE() << "the program outlived signal " << signal;
      ::kill(pid_, SIGKILL);
    }
    return reap();
  }

 private:
  // [ms] a change between the look and the watch is seen that much later
  static constexpr int kRecheck = 50, kUntilThere = 2;

  bool ended() {
    pollfd wake{end_, POLLIN, 0};
    return status_ || ::poll(&wake, 1, 0) != 0;
  }
  int reap() {
    if (int status = 0; !status_) {
      ::waitpid(pid_, &status, 0);
      status_ = status;
    }
    return *status_;
  }

  std::string folder_;
  pid_t pid_;
  int end_ = -1, changes_ = -1;
  std::optional<int> status_;
};

// The lock that a study holds on its folder, waited for until the last of its runs is gone.
class StudyLock {
 public:
  explicit StudyLock(const std::string& folder) : file_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    const auto deadline = std::chrono::steady_clock::now() + kLongEnough;
    while (!(held_ = ::flock(file_, LOCK_EX | LOCK_NB) == 0) && std::chrono::steady_clock::now() < deadline)
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  StudyLock(const StudyLock&) = delete;
  StudyLock& operator=(const StudyLock&) = delete;
  ~StudyLock() { ::close(file_); }
  bool held() const { return held_; }

 private:
  int file_;
  bool held_ = false;
};

}  // namespace isostat
