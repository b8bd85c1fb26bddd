#include "dem/solver/team.hpp"

#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace isostat {

// Workers wait for the generation to change, first spinning (a step of a small packing takes microseconds), then
// asleep in the kernel.
struct Team::Crew {
  std::atomic<unsigned> generation{0}, finished{0};
  std::atomic<bool> stop{false};
  const std::function<void(int)>* task = nullptr;
  int count = 0;
  std::mutex failure_lock;
  std::exception_ptr failure;
  std::vector<std::jthread> workers;  // last: they are joined before the rest goes

  void work(int member, int members) {
    try {
      for (int k = member; k < count; k += members) (*task)(k);
    } catch (...) {
      const std::scoped_lock hold(failure_lock);
      if (!failure) failure = std::current_exception();
    }
  }
};

namespace {
constexpr int kSpins = 2000;  // a few microseconds

void wait_while_equal(const std::atomic<unsigned>& value, unsigned old) {
  for (int s = 0; s < kSpins; ++s) {
    if (value.load(std::memory_order_acquire) != old) return;
#if defined(__x86_64__)
    __builtin_ia32_pause();
#endif
  }
  value.wait(old, std::memory_order_acquire);
}
}  // namespace

Team::Team(int threads) : threads_(threads < 1 ? 1 : threads) {
  if (threads_ == 1) return;
  crew_ = std::make_unique<Crew>();
  for (int member = 1; member < threads_; ++member)
    crew_->workers.emplace_back([crew = crew_.get(), member, members = threads_] {
      for (unsigned seen = 0;;) {
        wait_while_equal(crew->generation, seen);
        seen = crew->generation.load(std::memory_order_acquire);
        if (crew->stop.load(std::memory_order_acquire)) return;
        crew->work(member, members);
        crew->finished.fetch_add(1, std::memory_order_release);
        crew->finished.notify_one();
      }
    });
}

Team::~Team() {
  if (!crew_) return;
  crew_->stop.store(true, std::memory_order_release);
  crew_->generation.fetch_add(1, std::memory_order_release);
  crew_->generation.notify_all();
}

void Team::run_parallel(int count, const std::function<void(int)>& task) {
  crew_->task = &task;
  crew_->count = count;
  crew_->finished.store(0, std::memory_order_relaxed);
  crew_->generation.fetch_add(1, std::memory_order_release);
  crew_->generation.notify_all();
  crew_->work(0, threads_);
  for (unsigned done = crew_->finished.load(std::memory_order_acquire); done + 1 < static_cast<unsigned>(threads_);
       done = crew_->finished.load(std::memory_order_acquire))
    wait_while_equal(crew_->finished, done);
  if (crew_->failure) std::rethrow_exception(std::exchange(crew_->failure, nullptr));
}

}  // namespace isostat
