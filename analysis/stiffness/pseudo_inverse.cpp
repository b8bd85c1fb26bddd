#include "analysis/stiffness/pseudo_inverse.hpp"

#include <cmath>
#include <limits>

#include "analysis/vector_algebra.hpp"

namespace isostat {
namespace {

constexpr int kMostRefinements = 8;

std::vector<char> complement(const std::vector<char>& flags) {
  std::vector<char> c(flags.size());
  for (std::size_t i = 0; i < c.size(); ++i) c[i] = !flags[i];
  return c;
}

std::vector<double> residual(const SymmetricMatrix& a, const std::vector<double>& b, const std::vector<double>& x) {
  std::vector<double> r = a.multiply(x);
  for (std::size_t i = 0; i < r.size(); ++i) r[i] = b[i] - r[i];
  return r;
}

}  // namespace

PseudoInverse::PseudoInverse(const SymmetricMatrix& a, const std::vector<char>& dependent, SparseCholesky::Form form)
    : matrix_(a),
      independent_(complement(dependent)),
      norm_(a.maximum_norm()),
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

// Iterative refinement until the residual is rounding, |b - A x| <= 8 eps |A| |x| in the maximum norm, or stops
// halving. Which columns are independent is decided exactly and not by their length, so A_ii may be ill conditioned
// (1e13 in networks of 600 columns) where A on its range is not, and one step is then too few.
std::vector<double> PseudoInverse::solve(const std::vector<double>& b) const {
  const std::vector<double> inner = gather(b);
  std::vector<double> x = factor_.solve(inner);
  double before = std::numeric_limits<double>::infinity();
  for (int step = 0; step < kMostRefinements; ++step) {
    const std::vector<double> r = residual(inner_, inner, x);
    const double now = largest(r);
    if (now <= 8 * std::numeric_limits<double>::epsilon() * norm_ * largest(x) || !(now < 0.5 * before)) break;
    before = now;
    const std::vector<double> correction = factor_.solve(r);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += correction[i];
  }
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

}  // namespace isostat
