// Sparse symmetric matrices and their factorisation.
#pragma once
#include <array>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "analysis/stiffness/cholmod_factor.hpp"

namespace isostat {

// Lower triangle by columns, rows ascending.
struct SymmetricMatrix {
  std::int32_t size = 0;
  std::vector<std::int32_t> start, row;
  std::vector<double> value;
  std::vector<double> multiply(const std::vector<double>& x) const;
  double maximum_norm() const;  // largest row sum of magnitudes; 0 without columns
};

// The rows and columns with keep[i] != 0.
SymmetricMatrix principal_submatrix(const SymmetricMatrix& a, const std::vector<char>& keep);

// M^-1/2 A M^-1/2 with the diagonal `mass` of M (empty: the identity). Its null vectors are M^1/2 times those of A: the
// same columns depend on the same others.
SymmetricMatrix mass_scaled(SymmetricMatrix a, const std::vector<double>& mass);

class FactorisationFailed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class SparseCholesky {
 public:
  enum class Form {
    definite,    // L L^T, supernodal where it pays; fails on a nonpositive pivot
    indefinite,  // L D L^T with diagonal D, no pivoting; fails on a zero pivot
  };
  // Throws FactorisationFailed naming the column; std::bad_alloc out of memory.
  SparseCholesky(const SymmetricMatrix& a, Form form);

  std::vector<double> solve(const std::vector<double>& b) const { return factor_.solve(b); }
  std::array<std::int64_t, 2> inertia() const { return factor_.inertia(); }  // negative and positive pivots
  // Smallest over largest |pivot|: how far the signs are from doubt.
  double pivot_ratio() const { return factor_.pivot_ratio(); }
  std::int64_t factor_entries() const { return factor_.entries(); }  // nonzeros of L

 private:
  CholmodFactor factor_;
};

}  // namespace isostat
