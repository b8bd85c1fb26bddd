// Sparse matrices without symmetry and their factorisation by UMFPACK, whose types stay in the .cpp.
#pragma once
#include <cstdint>
#include <memory>
#include <vector>

namespace isostat {

// Compressed columns, rows ascending; equal entries are summed.
struct UnsymmetricMatrix {
  std::int32_t size = 0;
  std::vector<std::int32_t> start, row;
  std::vector<double> value;
  std::vector<double> multiply(const std::vector<double>& x) const;
};

struct Triplets {
  std::vector<std::int32_t> row, column;
  std::vector<double> value;
  void add(std::int32_t r, std::int32_t c, double v) { row.push_back(r), column.push_back(c), value.push_back(v); }
};
UnsymmetricMatrix assemble(std::int32_t size, const Triplets& triplets);

// |A - A^T| / |A + A^T| in Frobenius norms; 0 for a symmetric matrix, 0 for none.
double antisymmetric_part(const UnsymmetricMatrix& a);

class UnsymmetricLu {
 public:
  // Throws FactorisationFailed (sparse_cholesky.hpp) if A is singular. Keeps a reference to A.
  explicit UnsymmetricLu(const UnsymmetricMatrix& a);
  ~UnsymmetricLu();
  UnsymmetricLu(UnsymmetricLu&&) noexcept;
  std::vector<double> solve(const std::vector<double>& b) const;

 private:
  const UnsymmetricMatrix& matrix_;
  struct Internals;
  std::unique_ptr<Internals> internals_;
};

}  // namespace isostat
