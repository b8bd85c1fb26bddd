#include "analysis/stiffness/cholmod_factor.hpp"

#include <cholmod.h>

#include <new>
#include <stdexcept>
#include <string>

#include "analysis/one_thread.hpp"
#include "analysis/stiffness/sparse_cholesky.hpp"

namespace isostat {
namespace {

constexpr std::int32_t kNestedDissectionFrom = 50000;  // columns; below, AMD orders faster than it loses

// CHOLMOD takes matrices without columns or entries, but refuses null pointers even where it has nothing to read.
template <class T>
T* never_null(const std::vector<T>& v) {
  static T nothing{};
  return v.empty() ? &nothing : const_cast<T*>(v.data());
}

cholmod_sparse view_of(const SymmetricMatrix& a) {
  cholmod_sparse view{};
  view.nrow = view.ncol = static_cast<std::size_t>(a.size);
  view.nzmax = a.row.size();
  view.p = never_null(a.start);
  view.i = never_null(a.row);
  view.x = never_null(a.value);
  view.stype = -1;
  view.itype = CHOLMOD_INT;
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = view.packed = 1;
  return view;
}

}  // namespace

struct CholmodFactor::Internals {
  cholmod_common common;
  cholmod_factor* factor = nullptr;
  explicit Internals(Storage storage) {
    keep_libraries_to_one_thread();
    cholmod_start(&common);
    common.print = 0;
    common.supernodal = storage == Storage::simplicial ? CHOLMOD_SIMPLICIAL : CHOLMOD_AUTO;
    common.final_asis = 1;
    common.nmethods = 1;
    common.postorder = 1;
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

CholmodFactor::CholmodFactor(Storage storage) : internals_(std::make_unique<Internals>(storage)) {}
CholmodFactor::~CholmodFactor() = default;
CholmodFactor::CholmodFactor(CholmodFactor&&) noexcept = default;
CholmodFactor& CholmodFactor::operator=(CholmodFactor&&) noexcept = default;

void CholmodFactor::analyse(const SymmetricMatrix& a) {
  Internals& in = *internals_;
  cholmod_sparse view = view_of(a);
  cholmod_free_factor(&in.factor, &in.common);
  in.common.method[0].ordering = a.size < kNestedDissectionFrom ? CHOLMOD_AMD : CHOLMOD_METIS;
  in.factor = cholmod_analyze(&view, &in.common);
  in.check("analysis");
}

void CholmodFactor::factorise(const SymmetricMatrix& a) {
  cholmod_sparse view = view_of(a);
  cholmod_factorize(&view, internals_->factor, &internals_->common);
  internals_->check("factorisation");
}

bool CholmodFactor::not_positive_definite() const { return internals_->common.status == CHOLMOD_NOT_POSDEF; }
std::int64_t CholmodFactor::size() const {
  return internals_->factor ? static_cast<std::int64_t>(internals_->factor->n) : 0;
}
std::int64_t CholmodFactor::first_bad_pivot() const { return static_cast<std::int64_t>(internals_->factor->minor); }

std::vector<double> CholmodFactor::solve(const std::vector<double>& b) const {
  if (b.empty()) return {};
  cholmod_common& common = internals_->common;
  cholmod_dense view{};
  view.nrow = view.d = view.nzmax = b.size();
  view.ncol = 1;
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

std::array<std::int64_t, 2> CholmodFactor::inertia() const {
  const cholmod_factor& f = *internals_->factor;
  if (f.is_ll) return {0, static_cast<std::int64_t>(f.n)};
  std::array<std::int64_t, 2> count{0, 0};
  const auto* p = static_cast<const std::int32_t*>(f.p);
  const auto* x = static_cast<const double*>(f.x);
  for (std::size_t c = 0; c < f.n; ++c) ++count[x[p[c]] > 0 ? 1 : 0];  // D stands first in each column of L
  return count;
}

double CholmodFactor::pivot_ratio() const {
  return size() == 0 ? 1 : cholmod_rcond(internals_->factor, &internals_->common);
}

std::int64_t CholmodFactor::entries() const { return static_cast<std::int64_t>(internals_->common.lnz); }

}  // namespace isostat
