// Solutions of A x = b and null vectors for a singular symmetric matrix A whose null space is that of G, known exactly:
// columns that depend on others are fixed at zero (independent_columns.hpp), CHOLMOD solves for the rest. No threshold
// decides what is singular.
#pragma once
#include <vector>

#include "analysis/stiffness/sparse_cholesky.hpp"

namespace isostat {

class PseudoInverse {
 public:
  // dependent: one flag a column, see dependent_columns(). Throws FactorisationFailed if the rest is singular after all
  // (indefinite matrices only).
  PseudoInverse(const SymmetricMatrix& a, const std::vector<char>& dependent, SparseCholesky::Form form);

  std::size_t size() const { return independent_.size(); }
  std::size_t null_dimension() const { return null_.size(); }
  std::array<std::int64_t, 2> inertia() const { return factor_.inertia(); }
  std::int64_t factor_entries() const { return factor_.factor_entries(); }

  // Some solution of A x = b with zeros at the dependent columns; b in the range of A. Refined.
  std::vector<double> solve(const std::vector<double>& b) const;

  // Null vectors of A, one for each dependent column d: 1 at d, 0 at the other dependent columns.
  std::vector<double> null_vector(std::size_t dependent_column) const;

 private:
  std::vector<double> gather(const std::vector<double>& x) const;
  std::vector<double> scatter(const std::vector<double>& x) const;

  const SymmetricMatrix matrix_;
  std::vector<char> independent_;
  double norm_;
  std::vector<std::size_t> null_;  // dependent columns
  SymmetricMatrix inner_;
  SparseCholesky factor_;
};

}  // namespace isostat
