#include "analysis/stiffness/lowest_modes.hpp"

#include <Spectra/SymEigsSolver.h>
#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace isostat {
namespace {

constexpr Eigen::Index kMostRestarts = 1000;
constexpr double kLanczosTolerance = 1e-11;  // relative, of the eigenvalues 1 / lambda
// u^T A u is off by the square of the error of u and by eps |A|, 1 / theta by the error of the solve. The first is
// better as long as eps |A| is below 1e-8 of it.
constexpr double kRayleighFrom = 1e-8;

// M^-1/2 A M^-1/2, whose null vectors are M^1/2 times those of A: the same columns depend on the same others.
SymmetricMatrix mass_scaled(SymmetricMatrix a, const std::vector<double>& mass) {
  if (mass.empty()) return a;
  for (std::size_t c = 0; c < mass.size(); ++c)
    for (auto e = static_cast<std::size_t>(a.start[c]); e < static_cast<std::size_t>(a.start[c + 1]); ++e)
      a.value[e] /= std::sqrt(mass[c] * mass[static_cast<std::size_t>(a.row[e])]);
  return a;
}

// Operator type of Spectra.
struct ApplyPseudoInverse {
  using Scalar = double;
  const PseudoInverse& inverse;
  Eigen::Index rows() const { return static_cast<Eigen::Index>(inverse.size()); }
  Eigen::Index cols() const { return rows(); }
  void perform_op(const double* x, double* y) const {
    const std::vector<double> result = inverse.apply(std::vector<double>(x, x + inverse.size()));
    std::copy(result.begin(), result.end(), y);
  }
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

LowestModes lanczos_modes(const SymmetricMatrix& a, const std::vector<char>& dependent, std::size_t rank, int count,
                          bool definite, bool vectors) {
  const PseudoInverse inverse(a, dependent,
                              definite ? SparseCholesky::Form::definite : SparseCholesky::Form::indefinite);
  ApplyPseudoInverse op{inverse};
  const auto wanted = std::min(static_cast<std::size_t>(count), rank - 1);
  const auto subspace = std::min(std::max(2 * wanted + 10, std::size_t{24}), rank);
  Spectra::SymEigsSolver<ApplyPseudoInverse> solver(op, static_cast<Eigen::Index>(wanted),
                                                    static_cast<Eigen::Index>(subspace));
  std::vector<double> start(static_cast<std::size_t>(a.size));
  for (std::size_t i = 0; i < start.size(); ++i) start[i] = std::sin(1.0 + 0.7 * static_cast<double>(i));
  inverse.project_out_null_space(start);
  solver.init(start.data());
  const auto found = solver.compute(Spectra::SortRule::LargestMagn, kMostRestarts, kLanczosTolerance);
  LowestModes modes;
  modes.converged = solver.info() == Spectra::CompInfo::Successful;
  const auto values = solver.eigenvalues();
  const Eigen::MatrixXd eigenvectors = solver.eigenvectors(found);
  const double size_of_a = *std::max_element(a.value.begin(), a.value.end());
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    RayleighPair pair(a, eigenvectors.col(k));
    // Where independent columns are nearly dependent, N is off and u has a share of the null space, which A removes.
    const std::vector<double> product = a.multiply(inverse.apply(pair.vector()));
    const RayleighPair polished(a, Eigen::Map<const Eigen::VectorXd>(product.data(), a.size));
    if (polished.residual() < pair.residual()) pair = polished;
    modes.value.push_back(std::abs(pair.value()) > kRayleighFrom * size_of_a ? pair.value() : 1 / values[k]);
    if (vectors) modes.vector.push_back(pair.vector());
  }
  return modes;
}

// Columns that A couples, directly or through others: the spectrum of A is the union of those of its blocks. A gas is
// thousands of them, and equal pairs of grains have equal eigenvalues, of which Lanczos on the whole finds one.
std::vector<std::vector<std::size_t>> coupled_blocks(const SymmetricMatrix& a) {
  const auto n = static_cast<std::size_t>(a.size);
  std::vector<std::size_t> parent(n);
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto find = [&](std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (std::size_t c = 0; c < n; ++c)
    for (auto e = static_cast<std::size_t>(a.start[c]); e < static_cast<std::size_t>(a.start[c + 1]); ++e)
      parent[find(static_cast<std::size_t>(a.row[e]))] = find(c);
  std::vector<std::vector<std::size_t>> blocks;
  std::vector<std::size_t> block_of(n, n);
  for (std::size_t c = 0; c < n; ++c) {
    std::size_t& block = block_of[find(c)];
    if (block == n) block = blocks.size(), blocks.emplace_back();
    blocks[block].push_back(c);
  }
  return blocks;
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
                         int count, bool definite, bool vectors) {
  LowestModes all;
  if (count <= 0) return all;
  const SymmetricMatrix scaled = mass_scaled(a, mass);
  std::vector<std::vector<std::size_t>> columns_of;  // by mode in `all`: where its entries stand
  std::vector<std::int32_t> number(static_cast<std::size_t>(a.size), -1);
  for (const auto& columns : coupled_blocks(scaled)) {
    std::vector<char> dependent_here;
    for (std::size_t c : columns) dependent_here.push_back(dependent[c]);
    const auto null_dimension = static_cast<std::size_t>(std::count(dependent_here.begin(), dependent_here.end(), 1));
    const std::size_t rank = columns.size() - null_dimension;
    if (rank == 0) continue;
    const SymmetricMatrix block = block_matrix(scaled, columns, number);
    LowestModes here = block.size <= kDenseSize ? dense_modes(block, null_dimension, count, vectors)
                                                : lanczos_modes(block, dependent_here, rank, count, definite, vectors);
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
