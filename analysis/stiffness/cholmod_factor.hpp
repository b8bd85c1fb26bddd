// Owner of one CHOLMOD factorisation, A = L L^T or L D L^T with a fill-reducing ordering; one thread. What a pivot of
// the wrong sign means is for its users to say (sparse_cholesky, finishing/repeated_cholesky).
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace isostat {

struct SymmetricMatrix;

class CholmodFactor {
 public:
  enum class Storage { simplicial, automatic };  // automatic: supernodal blocks with BLAS where that pays, L L^T

  explicit CholmodFactor(Storage storage);
  ~CholmodFactor();
  CholmodFactor(CholmodFactor&&) noexcept;
  CholmodFactor& operator=(CholmodFactor&&) noexcept;

  // Ordering and symbolic factorisation. Throws std::bad_alloc or std::runtime_error.
  void analyse(const SymmetricMatrix& a);
  // Of a matrix with the pattern of the one analysed. Throws as analyse(); a bad pivot is no error.
  void factorise(const SymmetricMatrix& a);

  bool not_positive_definite() const;    // CHOLMOD stopped at a pivot of the wrong sign
  std::int64_t size() const;             // columns; 0 before analyse()
  std::int64_t first_bad_pivot() const;  // column, in the ordering; size(): none
  std::vector<double> solve(const std::vector<double>& b) const;
  std::array<std::int64_t, 2> inertia() const;  // pivots that are not positive, and those that are
  double pivot_ratio() const;                   // (min diag L / max diag L)^2, or min |D| / max |D|; 1 without columns
  std::int64_t entries() const;                 // of L

 private:
  struct Internals;
  std::unique_ptr<Internals> internals_;
};

}  // namespace isostat
