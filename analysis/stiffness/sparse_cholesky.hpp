// Sparse symmetric matrices and their factorisation by CHOLMOD, whose types stay in the .cpp.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <vector>

namespace isostat {

// Lower triangle by columns, rows ascending.
struct SymmetricMatrix {
  std::int32_t size = 0;
  std::vector<std::int32_t> start, row;
  std::vector<double> value;
  std::vector<double> multiply(const std::vector<double>& x) const;
};

// The rows and columns with keep[i] != 0.
SymmetricMatrix principal_submatrix(const SymmetricMatrix& a, const std::vector<char>& keep);

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
  ~SparseCholesky();
  SparseCholesky(SparseCholesky&&) noexcept;
  SparseCholesky& operator=(SparseCholesky&&) noexcept;

  std::vector<double> solve(const std::vector<double>& b) const;
  std::array<std::int64_t, 2> inertia() const;  // negative and positive pivots
  double pivot_ratio() const;                   // smallest over largest |pivot|: how far the signs are from doubt
  std::int64_t factor_entries() const;          // nonzeros of L

 private:
  struct Internals;
  std::unique_ptr<Internals> internals_;
};

}  // namespace isostat
