#include "analysis/stiffness/pseudo_inverse.hpp"

#include <cmath>
#include <stdexcept>

namespace isostat {
namespace {

std::vector<char> complement(const std::vector<char>& flags) {
  std::vector<char> c(flags.size());
  for (std::size_t i = 0; i < c.size(); ++i) c[i] = !flags[i];
  return c;
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double s = 0;
  for (std::size_t i = 0; i < a.size(); ++i) s += a[i] * b[i];
  return s;
}

void subtract(std::vector<double>& a, double factor, const std::vector<double>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] -= factor * b[i];
}

}  // namespace

PseudoInverse::PseudoInverse(const SymmetricMatrix& a, const std::vector<char>& dependent, SparseCholesky::Form form)
    : matrix_(a),
      independent_(complement(dependent)),
      inner_(principal_submatrix(a, independent_)),
      factor_(inner_, form) {
  for (std::size_t c = 0; c < dependent.size(); ++c)
    if (dependent[c]) null_.push_back(c);
}

std::vector<double> PseudoInverse::gather(const std::vector<double>& x) const {
  std::vector<double> y;
  y.reserve(static_cast<std::size_t>(inner_.size));
  for (std::size_t c = 0; c < x.size(); ++c)
    if (independent_[c]) y.push_back(x[c]);
  return y;
}

std::vector<double> PseudoInverse::scatter(const std::vector<double>& x) const {
  std::vector<double> y(independent_.size(), 0.0);
  for (std::size_t c = 0, k = 0; c < y.size(); ++c)
    if (independent_[c]) y[c] = x[k++];
  return y;
}

std::vector<double> PseudoInverse::solve(const std::vector<double>& b) const {
  const std::vector<double> inner = gather(b);
  std::vector<double> x = factor_.solve(inner);
  std::vector<double> residual = inner_.multiply(x);
  for (std::size_t i = 0; i < residual.size(); ++i) residual[i] = inner[i] - residual[i];
  const std::vector<double> correction = factor_.solve(residual);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += correction[i];
  return scatter(x);
}

std::vector<double> PseudoInverse::null_vector(std::size_t dependent_column) const {
  std::vector<double> unit(independent_.size(), 0.0);
  unit[dependent_column] = 1;
  std::vector<double> x = solve(matrix_.multiply(unit));
  for (double& v : x) v = -v;
  x[dependent_column] = 1;
  return x;
}

const std::vector<std::vector<double>>& PseudoInverse::null_basis() const {
  if (basis_) return *basis_;
  if (null_.size() * size() > kMostNullEntries)
    throw std::length_error(std::to_string(null_.size()) + " null vectors of " + std::to_string(size()) +
                            " entries are too many to store");
  std::vector<std::vector<double>> basis;
  for (std::size_t column : null_) {
    std::vector<double> x = null_vector(column);
    for (int pass = 0; pass < 2; ++pass)  // Gram-Schmidt twice is enough (Kahan and Parlett)
      for (const auto& q : basis) subtract(x, dot(q, x), q);
    const double length = std::sqrt(dot(x, x));
    for (double& v : x) v /= length;
    basis.push_back(std::move(x));
  }
  basis_ = std::move(basis);
  return *basis_;
}

void PseudoInverse::project_out_null_space(std::vector<double>& x) const {
  for (int pass = 0; pass < 2; ++pass)
    for (const auto& q : null_basis()) subtract(x, dot(q, x), q);
}

std::vector<double> PseudoInverse::apply(std::vector<double> x) const {
  project_out_null_space(x);
  x = solve(x);
  project_out_null_space(x);
  return x;
}

}  // namespace isostat
