#include "analysis/finishing/repeated_cholesky.hpp"

namespace isostat {

bool RepeatedCholesky::factorise(const SymmetricMatrix& a, std::int64_t pattern) {
  if (factor_.size() == 0 || pattern != pattern_) {
    factor_.analyse(a);
    pattern_ = pattern;
  }
  factor_.factorise(a);
  ++factorisations_;
  return !factor_.not_positive_definite() && factor_.first_bad_pivot() == factor_.size() && factor_.inertia()[0] == 0;
}

}  // namespace isostat
