// Things that wait for a descending number to pass their threshold. A heap of the next few and, below, buckets of equal
// ratio: most things wait long and are many, so they are only put down.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace isostat {

template <class T>
class ThresholdQueue {
 public:
  // Thresholds lie between the two, 0 < last <= first.
  ThresholdQueue(double first, double last) : first_(first), buckets_(bucket(last) + 1) {}

  void push(double threshold, const T& value) {
    const std::size_t b = bucket(threshold);
    ++size_;
    if (b > now_) return buckets_[std::min(b, buckets_.size() - 1)].push_back({threshold, value});
    next_.push_back({threshold, value});
    std::push_heap(next_.begin(), next_.end());
  }

  // Gives one whose threshold is at or above the number, if there is one.
  bool pop(double number, T& value) {
    while (next_.empty() && now_ < std::min(bucket(number), buckets_.size() - 1)) {
      next_ = std::exchange(buckets_[++now_], {});
      std::make_heap(next_.begin(), next_.end());
    }
    if (next_.empty() || next_.front().threshold < number) return false;
    std::pop_heap(next_.begin(), next_.end());
    value = next_.back().value;
    next_.pop_back();
    --size_;
    return true;
  }

  std::size_t size() const { return size_; }

 private:
  static constexpr double kBucketsPerE = 200;

  struct Waiting {
    double threshold;
    T value;
    friend bool operator<(const Waiting& a, const Waiting& b) { return a.threshold < b.threshold; }
  };

  std::size_t bucket(double threshold) const {
    return static_cast<std::size_t>(std::max(0.0, kBucketsPerE * std::log(first_ / threshold)));
  }

  double first_;
  std::size_t now_ = 0, size_ = 0;
  std::vector<std::vector<Waiting>> buckets_;
  std::vector<Waiting> next_;
};

}  // namespace isostat
