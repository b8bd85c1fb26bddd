#include "analysis/stiffness/sparse_cholesky.hpp"

#include <cholmod.h>

#include <algorithm>
#include <new>
#include <string>

#include "analysis/one_thread.hpp"

namespace isostat {
namespace {

constexpr std::int32_t kNestedDissectionFrom = 50000;  // columns; below, AMD orders faster than it loses

}  // namespace

std::vector<double> SymmetricMatrix::multiply(const std::vector<double>& x) const {
  std::vector<double> y(static_cast<std::size_t>(size), 0.0);
  for (std::size_t c = 0; c < y.size(); ++c) {
    double sum = 0;
    for (auto e = static_cast<std::size_t>(start[c]); e < static_cast<std::size_t>(start[c + 1]); ++e) {
      const auto r = static_cast<std::size_t>(row[e]);
      sum += value[e] * x[r];
      if (r != c) y[r] += value[e] * x[c];
    }
    y[c] += sum;
  }
  return y;
}

SymmetricMatrix principal_submatrix(const SymmetricMatrix& a, const std::vector<char>& keep) {
  std::vector<std::int32_t> number(static_cast<std::size_t>(a.size), -1);
  SymmetricMatrix s;
  for (std::size_t c = 0; c < number.size(); ++c)
    if (keep[c]) number[c] = s.size++;
  s.start.push_back(0);
  for (std::size_t c = 0; c < number.size(); ++c) {
    if (!keep[c]) continue;
    for (auto e = static_cast<std::size_t>(a.start[c]); e < static_cast<std::size_t>(a.start[c + 1]); ++e) {
      const std::int32_t r = number[static_cast<std::size_t>(a.row[e])];
      if (r >= 0) s.row.push_back(r), s.value.push_back(a.value[e]);
    }
    s.start.push_back(static_cast<std::int32_t>(s.row.size()));
  }
  return s;
}

struct SparseCholesky::Internals {
  mutable cholmod_common common;
  cholmod_factor* factor = nullptr;
  std::int64_t size = 0;
  Internals() {
    keep_libraries_to_one_thread();
    cholmod_start(&common);
    common.print = 0;
  }
  ~Internals() {
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
  Internals(const Internals&) = delete;
  Internals& operator=(const Internals&) = delete;

  void check(const char* what) const {
    if (common.status == CHOLMOD_OUT_OF_MEMORY || common.status == CHOLMOD_TOO_LARGE) throw std::bad_alloc();
    if (common.status < 0)
      throw std::runtime_error(std::string("CHOLMOD ") + what + " failed, status " + std::to_string(common.status));
  }
};

SparseCholesky::SparseCholesky(const SymmetricMatrix& a, Form form) : internals_(std::make_unique<Internals>()) {
  cholmod_common& common = internals_->common;
  common.final_asis = 1;
  if (form == Form::indefinite)
    common.supernodal = CHOLMOD_SIMPLICIAL;
  else
    common.supernodal = CHOLMOD_AUTO;
  common.nmethods = 1;
  common.method[0].ordering = a.size < kNestedDissectionFrom ? CHOLMOD_AMD : CHOLMOD_METIS;
  common.postorder = 1;
  internals_->size = a.size;

  cholmod_sparse view{};
  view.nrow = view.ncol = static_cast<std::size_t>(a.size);
  view.nzmax = a.row.size();
  view.p = const_cast<std::int32_t*>(a.start.data());
  view.i = const_cast<std::int32_t*>(a.row.data());
  view.x = const_cast<double*>(a.value.data());
  view.stype = -1;
  view.itype = CHOLMOD_INT;
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = 1;
  view.packed = 1;
  internals_->factor = cholmod_analyze(&view, &common);
  internals_->check("analysis");
  cholmod_factorize(&view, internals_->factor, &common);
  internals_->check("factorisation");
  const cholmod_factor& factor = *internals_->factor;
  if (common.status == CHOLMOD_NOT_POSDEF || (factor.minor < factor.n && form == Form::definite))
    throw FactorisationFailed("pivot " + std::to_string(factor.minor) + " of " + std::to_string(factor.n) +
                              " is not positive");
  if (factor.minor < factor.n) throw FactorisationFailed("pivot " + std::to_string(factor.minor) + " is zero");
}

SparseCholesky::~SparseCholesky() = default;
SparseCholesky::SparseCholesky(SparseCholesky&&) noexcept = default;
SparseCholesky& SparseCholesky::operator=(SparseCholesky&&) noexcept = default;

std::vector<double> SparseCholesky::solve(const std::vector<double>& b) const {
  if (b.empty()) return {};
  cholmod_common& common = internals_->common;
  cholmod_dense view{};
  view.nrow = view.d = b.size();
  view.ncol = 1;
  view.nzmax = b.size();
  view.x = const_cast<double*>(b.data());
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  cholmod_dense* x = cholmod_solve(CHOLMOD_A, internals_->factor, &view, &common);
  internals_->check("solve");
  const double* data = static_cast<const double*>(x->x);
  std::vector<double> result(data, data + b.size());
  cholmod_free_dense(&x, &common);
  return result;
}

std::array<std::int64_t, 2> SparseCholesky::inertia() const {
  const cholmod_factor& f = *internals_->factor;
  if (f.is_ll) return {0, static_cast<std::int64_t>(f.n)};
  std::array<std::int64_t, 2> count{0, 0};
  const auto* p = static_cast<const std::int32_t*>(f.p);
  const auto* x = static_cast<const double*>(f.x);
  for (std::size_t c = 0; c < f.n; ++c) ++count[x[p[c]] > 0 ? 1 : 0];  // D stands first in each column of L
  return count;
}

double SparseCholesky::pivot_ratio() const {
  cholmod_common& common = internals_->common;
  if (internals_->size == 0) return 1;
  return cholmod_rcond(internals_->factor, &common);  // (min diag L / max diag L)^2, or min |D| / max |D|
}

std::int64_t SparseCholesky::factor_entries() const { return static_cast<std::int64_t>(internals_->common.lnz); }

}  // namespace isostat
