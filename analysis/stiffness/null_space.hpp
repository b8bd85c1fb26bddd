// Null space of a singular symmetric matrix A in double precision, its dimension known exactly: one vector for each
// dependent column d, N = [1 at d, 0 at the other dependent columns, -A_ii^-1 A_id at the independent ones].
// A vector lives on the blocks of A_ii that touch its column; everywhere else the triangular solves give exact zeros,
// which are not stored. So a loose network with thousands of mechanisms, each on a few grains, costs little.
#pragma once
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "analysis/stiffness/sparse_cholesky.hpp"

namespace isostat {

class NullSpace {
 public:
  // vector_of(k): the k-th of `dimension` null vectors, `size` entries each. With the identity at the dependent columns
  // N^T N = 1 + Z^T Z has no eigenvalue below 1. Throws std::length_error above kMostEntries nonzeros.
  NullSpace(std::size_t size, std::size_t dimension, const std::function<std::vector<double>(std::size_t)>& vector_of);

  // x - N (N^T N)^-1 N^T x, twice: the second pass removes what rounding left of the first.
  void project_out(std::vector<double>& x) const;
  std::size_t entries() const { return row_.size(); }

  static constexpr std::size_t kMostEntries = 50'000'000;  // of N, and of N^T N: 600 MB each

 private:
  SparseCholesky factor_gram(std::size_t size) const;
  std::vector<std::size_t> start_;  // by vector
  std::vector<std::int32_t> row_;   // ascending
  std::vector<double> value_;
  std::optional<SparseCholesky> gram_;  // N^T N
};

}  // namespace isostat
