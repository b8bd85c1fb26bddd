// L D L^T of many symmetric matrices of one pattern: the ordering and the symbolic analysis are made once. Simplicial
// and without BLAS: the same bits whatever library is installed and however many threads it would like.
#pragma once
#include <cstdint>
#include <vector>

#include "analysis/stiffness/sparse_cholesky.hpp"

namespace isostat {

class RepeatedCholesky {
 public:
  // `pattern` names the pattern of `a`; another number than last time has it analysed anew. False if `a` is not
  // positive definite: there is no factor then. Throws std::bad_alloc out of memory.
  [[nodiscard]] bool factorise(const SymmetricMatrix& a, std::int64_t pattern);
  std::vector<double> solve(const std::vector<double>& b) const { return factor_.solve(b); }
  std::int64_t factorisations() const { return factorisations_; }

 private:
  CholmodFactor factor_{CholmodFactor::Storage::simplicial};
  std::int64_t pattern_ = -1, factorisations_ = 0;
};

}  // namespace isostat
