// Independent pieces of work on several threads, results in the order of the pieces.
#pragma once
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace isostat {

// work(k) for k < count. The first exception stops the rest and is thrown.
template <class Work>
auto side_by_side(std::size_t count, unsigned threads, Work&& work) {
  std::vector<decltype(work(std::size_t{}))> results(count);
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex lock;
  const auto run = [&] {
    for (std::size_t k = next++; k < count; k = next++) try {
        results[k] = work(k);
      } catch (...) {
        const std::scoped_lock hold(lock);
        if (!failure) failure = std::current_exception();
        next = count;
      }
  };
  {
    std::vector<std::jthread> team;
    for (unsigned t = 1; t < threads; ++t) team.emplace_back(run);
    run();
  }
  if (failure) std::rethrow_exception(failure);
  return results;
}

}  // namespace isostat
