#include "analysis/stiffness/lowest_modes.hpp"

#include <Spectra/SymEigsSolver.h>
#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace isostat {
namespace {

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

}  // namespace

LowestModes lowest_modes(const SymmetricMatrix& a, const std::vector<char>& dependent, std::vector<double> mass,
                         int count, bool definite, bool vectors) {
  const SymmetricMatrix scaled = mass_scaled(a, mass);
  const auto null_dimension = static_cast<std::size_t>(std::count(dependent.begin(), dependent.end(), 1));
  const auto rank = static_cast<std::size_t>(a.size) - null_dimension;
  LowestModes modes;
  if (rank == 0 || count <= 0) return modes;
  if (a.size <= kDenseSize) {
    modes = dense_modes(scaled, null_dimension, count, vectors);
  } else {
    const PseudoInverse inverse(scaled, dependent,
                                definite ? SparseCholesky::Form::definite : SparseCholesky::Form::indefinite);
    ApplyPseudoInverse op{inverse};
    const auto wanted = std::min(static_cast<std::size_t>(count), rank - 1);
    const auto subspace = std::min(std::max(2 * wanted + 10, std::size_t{24}), rank);
    Spectra::SymEigsSolver<ApplyPseudoInverse> solver(op, static_cast<Eigen::Index>(wanted),
                                                      static_cast<Eigen::Index>(subspace));
    Eigen::VectorXd first(a.size);
    for (Eigen::Index i = 0; i < first.size(); ++i) first[i] = std::sin(1.0 + 0.7 * static_cast<double>(i));
    std::vector<double> start(first.data(), first.data() + first.size());
    inverse.project_out_null_space(start);
    solver.init(start.data());
    const auto found = solver.compute(Spectra::SortRule::LargestMagn, 1000, 1e-11);
    modes.converged = solver.info() == Spectra::CompInfo::Successful;
    const auto values = solver.eigenvalues();
    const auto eigenvectors = vectors ? solver.eigenvectors(found) : Eigen::MatrixXd();
    for (Eigen::Index k = 0; k < values.size(); ++k) {
      modes.value.push_back(1 / values[k]);
      if (vectors)
        modes.vector.emplace_back(eigenvectors.col(k).data(), eigenvectors.col(k).data() + eigenvectors.rows());
    }
  }
  if (vectors && !mass.empty())
    for (auto& v : modes.vector)
      for (std::size_t i = 0; i < v.size(); ++i) v[i] /= std::sqrt(mass[i]);
  return modes;
}

}  // namespace isostat
