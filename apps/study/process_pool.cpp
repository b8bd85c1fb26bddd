#include "apps/study/process_pool.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <system_error>
#include <thread>
#include <utility>

#include "apps/commands.hpp"

namespace isostat {
namespace {

constexpr int kTickMilliseconds = 100;

std::atomic<bool> stop_flag{false}, cut_flag{false};
int message_pipe = -1;

[[noreturn]] void fail(const char* what) { throw std::system_error(errno, std::generic_category(), what); }

class Pipe {
 public:
  Pipe() {
    if (::pipe2(ends_, O_CLOEXEC) != 0) fail("pipe");
  }
  ~Pipe() { close_read(), close_write(); }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  int read_end() const { return ends_[0]; }
  int write_end() const { return ends_[1]; }
  void close_read() { close(ends_[0]); }
  void close_write() { close(ends_[1]); }
  int take_read() { return std::exchange(ends_[0], -1); }

 private:
  static void close(int& end) {
    if (end >= 0) ::close(std::exchange(end, -1));
  }
  int ends_[2] = {-1, -1};
};

struct Child {
  std::size_t task;
  pid_t pid;
  int messages;        // read end
  std::string unread;  // the beginning of a line
};

// The task's side: waits for the end of the stop pipe, which comes when the parent closes it or is gone.
void listen(int stop_pipe) {
  char byte;
  while (::read(stop_pipe, &byte, 1) < 0 && errno == EINTR) {
  }
  stop_flag = true;
  if (cut_flag) ::_exit(exit_interrupted);
}

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ';');
  return text;
}

[[noreturn]] void be_child(std::size_t number, const std::function<int(std::size_t)>& task, int stop_pipe) {
  for (const int s : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) std::signal(s, SIG_IGN);
  int code = exit_internal;
  try {
    std::thread(listen, stop_pipe).detach();
    code = task(number);
  } catch (const std::bad_alloc&) {
    TaskLink::send("error: not enough memory");
  } catch (const std::exception& e) {
    TaskLink::send("error: " + one_line(e.what()));
  }
  ::_exit(code);  // the parent's open files and exit handlers are not ours
}

class Pool {
 public:
  Pool(std::vector<std::size_t> tasks, std::size_t at_a_time, const std::function<int(std::size_t)>& task,
       const PoolWatch& watch)
      : tasks_(std::move(tasks)), at_a_time_(std::max<std::size_t>(1, at_a_time)), task_(task), watch_(watch) {}

  ~Pool() {  // only after an exception are there any left
    stop_.close_write();
    for (Child& c : children_) ::close(c.messages), wait_for(c);
  }

  void run() {
    for (;;) {
      if (watch_.stop && watch_.stop()) {
        next_ = tasks_.size();
        stop_.close_write();
      }
      while (children_.size() < at_a_time_ && next_ < tasks_.size()) start(tasks_[next_++]);
      if (children_.empty()) return;
      listen_to_all();
      if (watch_.tick) watch_.tick();
    }
  }

 private:
  void start(std::size_t task) {
    Pipe messages;
    std::fflush(nullptr);
    const pid_t pid = ::fork();
    if (pid < 0) fail("fork");
    if (pid == 0) {
      stop_.close_write();
      messages.close_read();
      message_pipe = messages.write_end();
      be_child(task, task_, stop_.read_end());
    }
    children_.push_back({task, pid, messages.take_read(), {}});
    if (watch_.started) watch_.started(task);
  }

  void listen_to_all() {
    std::vector<pollfd> waits;
    for (const Child& c : children_) waits.push_back({c.messages, POLLIN, 0});
    if (::poll(waits.data(), waits.size(), kTickMilliseconds) <= 0) return;
    std::vector<Child> staying;
    for (std::size_t k = 0; k < children_.size(); ++k) {
      Child& c = children_[k];
      if (waits[k].revents == 0 || receive(c)) {
        staying.push_back(std::move(c));
        continue;
      }
      ::close(c.messages);
      const int code = wait_for(c);
      ended_.emplace_back(c.task, code);
    }
    children_ = std::move(staying);
    for (const auto& [task, code] : std::exchange(ended_, {}))
      if (watch_.ended) watch_.ended(task, code);
  }

  // False at the end of the messages, that is of the task.
  bool receive(Child& c) {
    char buffer[4096];
    const ssize_t got = ::read(c.messages, buffer, sizeof buffer);
    if (got < 0) return errno == EINTR || errno == EAGAIN;
    c.unread.append(buffer, static_cast<std::size_t>(got));
    for (std::size_t end; (end = c.unread.find('\n')) != std::string::npos; c.unread.erase(0, end + 1))
      if (watch_.line) watch_.line(c.task, c.unread.substr(0, end));
    return got > 0;
  }

  static int wait_for(const Child& c) {
    int status = 0;
    while (::waitpid(c.pid, &status, 0) < 0 && errno == EINTR) {
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

  std::vector<std::size_t> tasks_;
  std::size_t at_a_time_, next_ = 0;
  const std::function<int(std::size_t)>& task_;
  const PoolWatch& watch_;
  Pipe stop_;  // never written to: its closing is the message
  std::vector<Child> children_;
  std::vector<std::pair<std::size_t, int>> ended_;
};

}  // namespace

bool TaskLink::stop_requested() { return stop_flag.load(std::memory_order_relaxed); }

void TaskLink::send(const std::string& line) {
  const std::string text = line + "\n";
  for (std::size_t sent = 0; sent < text.size();) {
    const ssize_t n = ::write(message_pipe, text.data() + sent, text.size() - sent);
    if (n < 0 && errno != EINTR) return;  // nobody listens any more
    if (n > 0) sent += static_cast<std::size_t>(n);
  }
}

void TaskLink::may_be_cut_short() {
  cut_flag = true;
  if (stop_flag) ::_exit(exit_interrupted);
}

void run_in_processes(const std::vector<std::size_t>& tasks, std::size_t at_a_time,
                      const std::function<int(std::size_t)>& task, const PoolWatch& watch) {
  Pool(tasks, at_a_time, task, watch).run();
}

}  // namespace isostat
