#include "analysis/stiffness/unsymmetric_lu.hpp"

#include <umfpack.h>

#include <cmath>
#include <new>
#include <string>

#include "analysis/one_thread.hpp"
#include "analysis/stiffness/sparse_cholesky.hpp"

namespace isostat {
namespace {

void check(int status) {
  if (status == UMFPACK_ERROR_out_of_memory) throw std::bad_alloc();
  if (status == UMFPACK_WARNING_singular_matrix) throw FactorisationFailed("the tangent stiffness is singular");
  if (status != UMFPACK_OK) throw FactorisationFailed("UMFPACK status " + std::to_string(status));
}

}  // namespace

std::vector<double> UnsymmetricMatrix::multiply(const std::vector<double>& x) const {
  std::vector<double> y(static_cast<std::size_t>(size), 0.0);
  for (std::size_t c = 0; c < y.size(); ++c)
    for (auto e = static_cast<std::size_t>(start[c]); e < static_cast<std::size_t>(start[c + 1]); ++e)
      y[static_cast<std::size_t>(row[e])] += value[e] * x[c];
  return y;
}

UnsymmetricMatrix assemble(std::int32_t size, const Triplets& t) {
  UnsymmetricMatrix a;
  a.size = size;
  a.start.assign(static_cast<std::size_t>(size) + 1, 0);
  a.row.resize(t.value.size()), a.value.resize(t.value.size());
  if (t.value.empty()) return a;
  check(umfpack_di_triplet_to_col(size, size, static_cast<std::int32_t>(t.value.size()), t.row.data(), t.column.data(),
                                  t.value.data(), a.start.data(), a.row.data(), a.value.data(), nullptr));
  a.row.resize(static_cast<std::size_t>(a.start.back())), a.value.resize(static_cast<std::size_t>(a.start.back()));
  return a;
}

double antisymmetric_part(const UnsymmetricMatrix& a) {
  double squares[2];
  for (int sign : {-1, 1}) {
    Triplets both;
    for (std::int32_t c = 0; c < a.size; ++c)
      for (auto e = static_cast<std::size_t>(a.start[static_cast<std::size_t>(c)]);
           e < static_cast<std::size_t>(a.start[static_cast<std::size_t>(c) + 1]); ++e)
        both.add(a.row[e], c, a.value[e]), both.add(c, a.row[e], sign * a.value[e]);
    double& sum = squares[sign > 0] = 0;
    for (double v : assemble(a.size, both).value) sum += v * v;
  }
  return squares[1] > 0 ? std::sqrt(squares[0] / squares[1]) : 0;
}

struct UnsymmetricLu::Internals {
  void* numeric = nullptr;
  ~Internals() { umfpack_di_free_numeric(&numeric); }
};

UnsymmetricLu::UnsymmetricLu(const UnsymmetricMatrix& a) : matrix_(a), internals_(std::make_unique<Internals>()) {
  if (a.size == 0) return;
  keep_libraries_to_one_thread();
  void* symbolic = nullptr;
  int status =
      umfpack_di_symbolic(a.size, a.size, a.start.data(), a.row.data(), a.value.data(), &symbolic, nullptr, nullptr);
  if (status == UMFPACK_OK)
    status = umfpack_di_numeric(a.start.data(), a.row.data(), a.value.data(), symbolic, &internals_->numeric, nullptr,
                                nullptr);
  umfpack_di_free_symbolic(&symbolic);
  check(status);
}

UnsymmetricLu::~UnsymmetricLu() = default;
UnsymmetricLu::UnsymmetricLu(UnsymmetricLu&&) noexcept = default;

std::vector<double> UnsymmetricLu::solve(const std::vector<double>& b) const {
  std::vector<double> x(b.size());
  if (b.empty()) return x;
  check(umfpack_di_solve(UMFPACK_A, matrix_.start.data(), matrix_.row.data(), matrix_.value.data(), x.data(), b.data(),
                         internals_->numeric, nullptr, nullptr));  // refines by itself
  return x;
}

}  // namespace isostat
