#include "analysis/finishing/repeated_cholesky.hpp"

#include <cholmod.h>

#include <new>
#include <stdexcept>
#include <string>

namespace isostat {
namespace {

constexpr std::int32_t kNestedDissectionFrom = 50000;  // columns; below, minimum degree is as good and faster

cholmod_sparse view_of(const SymmetricMatrix& a) {
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
  view.sorted = view.packed = 1;
  return view;
}

}  // namespace

struct RepeatedCholesky::Internals {
  cholmod_common common;
  cholmod_factor* factor = nullptr;
  std::int64_t pattern = -1, factorisations = 0;
  Internals() {
    cholmod_start(&common);
    common.print = 0;
    common.supernodal = CHOLMOD_SIMPLICIAL;
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
  bool positive() const {  // D stands first in each column of L
    const auto* p = static_cast<const std::int32_t*>(factor->p);
    const auto* x = static_cast<const double*>(factor->x);
    for (std::size_t c = 0; c < factor->n; ++c)
      if (!(x[p[c]] > 0)) return false;
    return true;
  }
};

RepeatedCholesky::RepeatedCholesky() : internals_(std::make_unique<Internals>()) {}
RepeatedCholesky::~RepeatedCholesky() = default;

bool RepeatedCholesky::factorise(const SymmetricMatrix& a, std::int64_t pattern) {
  Internals& in = *internals_;
  cholmod_sparse view = view_of(a);
  if (!in.factor || pattern != in.pattern) {
    cholmod_free_factor(&in.factor, &in.common);
    in.common.method[0].ordering = a.size < kNestedDissectionFrom ? CHOLMOD_AMD : CHOLMOD_METIS;
    in.factor = cholmod_analyze(&view, &in.common);
    in.check("analysis");
    in.pattern = pattern;
  }
  cholmod_factorize(&view, in.factor, &in.common);
  in.check("factorisation");
  ++in.factorisations;
  return in.common.status != CHOLMOD_NOT_POSDEF && in.factor->minor == in.factor->n && in.positive();
}

std::vector<double> RepeatedCholesky::solve(const std::vector<double>& b) const {
  if (b.empty()) return {};
  Internals& in = *internals_;
  cholmod_dense view{};
  view.nrow = view.d = view.nzmax = b.size();
  view.ncol = 1;
  view.x = const_cast<double*>(b.data());
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  cholmod_dense* x = cholmod_solve(CHOLMOD_A, in.factor, &view, &in.common);
  in.check("solve");
  const double* data = static_cast<const double*>(x->x);
  std::vector<double> result(data, data + b.size());
  cholmod_free_dense(&x, &in.common);
  return result;
}

std::int64_t RepeatedCholesky::factorisations() const { return internals_->factorisations; }

}  // namespace isostat
