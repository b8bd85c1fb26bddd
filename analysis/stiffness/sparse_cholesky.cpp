#include "analysis/stiffness/sparse_cholesky.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace isostat {

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

double SymmetricMatrix::maximum_norm() const {
  std::vector<double> sum(static_cast<std::size_t>(size), 0.0);
  for (std::size_t c = 0; c < sum.size(); ++c)
    for (auto e = static_cast<std::size_t>(start[c]); e < static_cast<std::size_t>(start[c + 1]); ++e) {
      const auto r = static_cast<std::size_t>(row[e]);
      sum[r] += std::abs(value[e]);
      if (r != c) sum[c] += std::abs(value[e]);
    }
  return sum.empty() ? 0 : *std::max_element(sum.begin(), sum.end());
}

SymmetricMatrix mass_scaled(SymmetricMatrix a, const std::vector<double>& mass) {
  for (std::size_t c = 0; c < mass.size(); ++c)
    for (auto e = static_cast<std::size_t>(a.start[c]); e < static_cast<std::size_t>(a.start[c + 1]); ++e)
      a.value[e] /= std::sqrt(mass[c] * mass[static_cast<std::size_t>(a.row[e])]);
  return a;
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

SparseCholesky::SparseCholesky(const SymmetricMatrix& a, Form form)
    : factor_(form == Form::indefinite ? CholmodFactor::Storage::simplicial : CholmodFactor::Storage::automatic) {
  factor_.analyse(a);
  factor_.factorise(a);
  const std::int64_t bad = factor_.first_bad_pivot(), size = factor_.size();
  if (factor_.not_positive_definite() || (bad < size && form == Form::definite))
    throw FactorisationFailed("pivot " + std::to_string(bad) + " of " + std::to_string(size) + " is not positive");
  if (bad < size) throw FactorisationFailed("pivot " + std::to_string(bad) + " is zero");
}

}  // namespace isostat
