// Union-find: which of n things are joined, directly or through others.
#pragma once
#include <cstddef>
#include <numeric>
#include <vector>

namespace isostat {

class UnionFind {
 public:
  explicit UnionFind(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }

  std::size_t find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  // False if they were joined before.
  bool join(std::size_t a, std::size_t b) {
    a = find(a), b = find(b);
    parent_[a] = b;
    return a != b;
  }
  // By the order of their first members, members ascending: whatever the order of the joins.
  std::vector<std::vector<std::size_t>> sets() {
    const std::size_t n = parent_.size();
    std::vector<std::vector<std::size_t>> all;
    std::vector<std::size_t> set_of(n, n);
    for (std::size_t i = 0; i < n; ++i) {
      std::size_t& set = set_of[find(i)];
      if (set == n) set = all.size(), all.emplace_back();
      all[set].push_back(i);
    }
    return all;
  }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace isostat
