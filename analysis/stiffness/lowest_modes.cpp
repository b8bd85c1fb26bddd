#include "analysis/stiffness/lowest_modes.hpp"

#include <Spectra/SymEigsSolver.h>
#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/union_find.hpp"

namespace isostat {
namespace {

constexpr Eigen::Index kMostRestarts = 1000;
// Of the Ritz vectors, relative; the Rayleigh quotients are off by its square.
constexpr double kLanczosTolerance = 3e-11;
// sigma / sqrt(|A| lambda). The factorisation is off by E ~ 1e2 eps |A|; what it makes of a range vector has a share
// E / sigma in null A, and as much of that comes back: residuals of (E / sigma)^2 lambda ~ 1e-10 |A|.
constexpr double kShift = 5e-9;
constexpr double kFirstMost = 0.1, kFirstColumns = 1e3;  // first lambda / |A|: at most, and columns for 1
constexpr double kSmallestShift = 1e-13;                 // of |A|: A + sigma stays positive beyond rounding
constexpr int kMostShifts = 3;

// T = B^-1 A B^-1 A B^-1 with B = A + sigma, operator type of Spectra. To an eigenvalue lambda of A belongs
// lambda^2 / (lambda + sigma)^3: the null space of A goes to zero without being known, modes with lambda well above
// sigma go to 1 / lambda, and softer ones stand before the k-th as long as lambda^2 > sigma^3 / lambda_k.
class FilteredInverse {
 public:
  using Scalar = double;
  FilteredInverse(const SymmetricMatrix& a, double sigma, SparseCholesky::Form form)
      : a_(a), factor_(shifted(a, sigma), form) {}
  Eigen::Index rows() const { return a_.size; }
  Eigen::Index cols() const { return rows(); }
  void perform_op(const double* x, double* y) const {
    const std::vector<double> result = factor_.solve(range_part(range_part(std::vector<double>(x, x + a_.size))));
    std::copy(result.begin(), result.end(), y);
  }
  // A B^-1 x, without the share of x in null A.
  std::vector<double> range_part(const std::vector<double>& x) const { return a_.multiply(factor_.solve(x)); }

 private:
  static SymmetricMatrix shifted(SymmetricMatrix a, double sigma) {
    for (std::size_t c = 0; c < static_cast<std::size_t>(a.size); ++c)  // the diagonal stands first in each column
      a.value[static_cast<std::size_t>(a.start[c])] += sigma;
    return a;
  }
  const SymmetricMatrix& a_;
  SparseCholesky factor_;
};

LowestModes dense_modes(const SymmetricMatrix& a, std::size_t null_dimension, int count, bool vectors) {
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(a.size, a.size);
  for (std::int32_t c = 0; c < a.size; ++c)
    for (auto e = static_cast<std::size_t>(a.start[static_cast<std::size_t>(c)]);
         e < static_cast<std::size_t>(a.start[static_cast<std::size_t>(c) + 1]); ++e)
      dense(a.row[e], c) = dense(c, a.row[e]) = a.value[e];
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(dense);
  std::vector<Eigen::Index> order(static_cast<std::size_t>(a.size));
  std::iota(order.begin(), order.end(), 0);
  const auto& lambda = solver.eigenvalues();
  std::stable_sort(order.begin(), order.end(),
                   [&](auto i, auto j) { return std::abs(lambda[i]) < std::abs(lambda[j]); });
  LowestModes modes;
  for (std::size_t k = null_dimension; k < order.size() && modes.value.size() < static_cast<std::size_t>(count); ++k) {
    modes.value.push_back(lambda[order[k]]);
    if (vectors) {
      const Eigen::VectorXd v = solver.eigenvectors().col(order[k]);
      modes.vector.emplace_back(v.data(), v.data() + v.size());
    }
  }
  return modes;
}

// A unit vector u, u^T A u, and |A u - (u^T A u) u|.
class RayleighPair {
 public:
  RayleighPair(const SymmetricMatrix& a, const Eigen::VectorXd& u) : u_(u.normalized()) {
    const std::vector<double> product = a.multiply(vector());
    const Eigen::Map<const Eigen::VectorXd> au(product.data(), u_.size());
    value_ = u_.dot(au);
    residual_ = (au - value_ * u_).norm();
  }
  double value() const { return value_; }
  double residual() const { return residual_; }
  std::vector<double> vector() const { return {u_.data(), u_.data() + u_.size()}; }

 private:
  Eigen::VectorXd u_;
  double value_ = 0, residual_ = 0;
};

// The modes nearest to zero seen through one shift, and the largest of their |lambda|.
LowestModes modes_at_shift(const SymmetricMatrix& a, double sigma, std::size_t wanted, std::size_t rank, bool definite,
                           bool vectors) {
  FilteredInverse op(a, sigma, definite ? SparseCholesky::Form::definite : SparseCholesky::Form::indefinite);
  const auto subspace = std::min(std::max(3 * wanted + 20, std::size_t{40}), rank);
  Spectra::SymEigsSolver<FilteredInverse> solver(op, static_cast<Eigen::Index>(wanted),
                                                 static_cast<Eigen::Index>(subspace));
  std::vector<double> start(static_cast<std::size_t>(a.size));
  for (std::size_t i = 0; i < start.size(); ++i) start[i] = std::sin(1.0 + 0.7 * static_cast<double>(i));
  start = op.range_part(start);
  solver.init(start.data());
  const auto found = solver.compute(Spectra::SortRule::LargestMagn, kMostRestarts, kLanczosTolerance);
  LowestModes modes;
  modes.converged = solver.info() == Spectra::CompInfo::Successful;
  const Eigen::MatrixXd eigenvectors = solver.eigenvectors(found);
  for (Eigen::Index k = 0; k < eigenvectors.cols(); ++k) {
    RayleighPair pair(a, eigenvectors.col(k));
    const std::vector<double> filtered = op.range_part(pair.vector());
    const RayleighPair polished(a, Eigen::Map<const Eigen::VectorXd>(filtered.data(), a.size));
    if (polished.residual() < pair.residual()) pair = polished;
    modes.value.push_back(pair.value());
    if (vectors) modes.vector.push_back(pair.vector());
  }
  return modes;
}

// The shift is made for the modes that are expected; where those found are so soft that softer ones could hide behind
// it, it is made smaller for them.
LowestModes lanczos_modes(const SymmetricMatrix& a, std::size_t rank, int count, bool definite, bool vectors,
                          double softest) {
  const auto wanted = std::min(static_cast<std::size_t>(count), rank - 1);
  const double norm = a.maximum_norm();
  double of = norm * std::min(kFirstMost, kFirstColumns / a.size);  // eigenvalue that the shift is made for
  for (int shift = 1;; ++shift) {
    const double sigma = std::max(kShift * std::sqrt(norm * of), kSmallestShift * norm);
    LowestModes modes = modes_at_shift(a, sigma, wanted, rank, definite, vectors);
    double largest = 0;
    for (double lambda : modes.value) largest = std::max(largest, std::abs(lambda));
    const bool seen = sigma * sigma * sigma <= largest * softest * softest * norm * norm;
    if (seen || !modes.converged || sigma <= kSmallestShift * norm || shift == kMostShifts) return modes;
    of = std::min(largest, 0.1 * of);
  }
}

// Columns that A couples, directly or through others: the spectrum of A is the union of those of its blocks. A gas is
// thousands of them, and equal pairs of grains have equal eigenvalues, of which Lanczos on the whole finds one.
std::vector<std::vector<std::size_t>> coupled_blocks(const SymmetricMatrix& a) {
  const auto n = static_cast<std::size_t>(a.size);
  UnionFind coupled(n);
  for (std::size_t c = 0; c < n; ++c)
    for (auto e = static_cast<std::size_t>(a.start[c]); e < static_cast<std::size_t>(a.start[c + 1]); ++e)
      coupled.join(static_cast<std::size_t>(a.row[e]), c);
  return coupled.sets();
}

SymmetricMatrix block_matrix(const SymmetricMatrix& a, const std::vector<std::size_t>& columns,
                             std::vector<std::int32_t>& number) {
  for (std::size_t k = 0; k < columns.size(); ++k) number[columns[k]] = static_cast<std::int32_t>(k);
  SymmetricMatrix block;
  block.size = static_cast<std::int32_t>(columns.size());
  block.start.push_back(0);
  for (std::size_t c : columns) {
    for (auto e = static_cast<std::size_t>(a.start[c]); e < static_cast<std::size_t>(a.start[c + 1]); ++e)
      block.row.push_back(number[static_cast<std::size_t>(a.row[e])]), block.value.push_back(a.value[e]);
    block.start.push_back(static_cast<std::int32_t>(block.row.size()));
  }
  return block;
}

}  // namespace

LowestModes lowest_modes(const SymmetricMatrix& a, const std::vector<char>& dependent, std::vector<double> mass,
                         int count, bool definite, bool vectors, double softest) {
  LowestModes all;
  if (count <= 0) return all;
  const SymmetricMatrix scaled = mass_scaled(a, mass);
  std::vector<std::vector<std::size_t>> columns_of;  // by mode in `all`: where its entries stand
  std::vector<std::int32_t> number(static_cast<std::size_t>(a.size), -1);
  for (const auto& columns : coupled_blocks(scaled)) {
    std::size_t null_dimension = 0;
    for (std::size_t c : columns) null_dimension += dependent[c] != 0;
    const std::size_t rank = columns.size() - null_dimension;
    if (rank == 0) continue;
    const SymmetricMatrix block = block_matrix(scaled, columns, number);
    const bool dense = block.size <= kDenseSize || count >= block.size / 3;
    LowestModes here = dense ? dense_modes(block, null_dimension, count, vectors)
                             : lanczos_modes(block, rank, count, definite, vectors, softest);
    all.converged = all.converged && here.converged;
    all.value.insert(all.value.end(), here.value.begin(), here.value.end());
    for (auto& v : here.vector) all.vector.push_back(std::move(v)), columns_of.push_back(columns);
  }

  std::vector<std::size_t> order(all.value.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t i, std::size_t j) { return std::abs(all.value[i]) < std::abs(all.value[j]); });
  order.resize(std::min(order.size(), static_cast<std::size_t>(count)));
  LowestModes modes;
  modes.converged = all.converged;
  for (std::size_t k : order) {
    modes.value.push_back(all.value[k]);
    if (!vectors) continue;
    std::vector<double> whole(static_cast<std::size_t>(a.size), 0.0);
    for (std::size_t i = 0; i < columns_of[k].size(); ++i) {
      const std::size_t c = columns_of[k][i];
      whole[c] = mass.empty() ? all.vector[k][i] : all.vector[k][i] / std::sqrt(mass[c]);
    }
    modes.vector.push_back(std::move(whole));
  }
  return modes;
}

}  // namespace isostat
