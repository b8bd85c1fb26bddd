// Modes of loose networks: thousands of zero modes, many pieces. Oracle: dense eigenvalues of the whole.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "analysis/rigidity/independent_columns.hpp"
#include "analysis/stiffness/lowest_modes.hpp"
#include "analysis/stiffness/null_space.hpp"
#include "analysis/stiffness/soft_modes.hpp"
#include "analysis/stiffness/stiffness_matrix.hpp"
#include "tests/oracle/random_network.hpp"

namespace isostat {
namespace {

Packing<2> loose(std::uint64_t seed, double z, int size) {
  RandomNetwork o;
  o.columns = o.rows = size, o.seed = seed, o.coordination = z;
  return random_network(o);
}

Eigen::MatrixXd dense(const SymmetricMatrix& a) {
  Eigen::MatrixXd d = Eigen::MatrixXd::Zero(a.size, a.size);
  for (std::int32_t c = 0; c < a.size; ++c)
    for (auto e = static_cast<std::size_t>(a.start[static_cast<std::size_t>(c)]);
         e < static_cast<std::size_t>(a.start[static_cast<std::size_t>(c) + 1]); ++e)
      d(a.row[e], c) = d(c, a.row[e]) = a.value[e];
  return d;
}

SymmetricMatrix unit_stiffness(const Packing<2>& p, NetworkLaw law, bool cell_free) {
  const RigidityMatrix g = rigidity_matrix(p, law, cell_free);
  return weighted_normal_matrix(g, std::vector<double>(static_cast<std::size_t>(g.rows()), 1.0));
}

double smallest_independent(const Eigen::MatrixXd& a, const std::vector<char>& dependent) {
  std::vector<Eigen::Index> kept;
  for (std::size_t c = 0; c < dependent.size(); ++c)
    if (!dependent[c]) kept.push_back(static_cast<Eigen::Index>(c));
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(a(kept, kept), Eigen::EigenvaluesOnly).eigenvalues()[0];
}

TEST(LooseModes, EqualDenseOnesWithManyZeroModes) {
  for (const double z : {0.4, 1.6, 2.6, 3.2})
    for (const NetworkLaw law : {NetworkLaw::frictionless, NetworkLaw::friction, NetworkLaw::rolling})
      for (const bool cell_free : {false, true}) {
        const Packing<2> p = loose(7, z, 14);
        const SymmetricMatrix a = unit_stiffness(p, law, cell_free);
        ASSERT_GT(a.size, kDenseSize);
        const auto dependent = dependent_columns(p, law, cell_free);
        const auto zero = std::count(dependent.begin(), dependent.end(), 1);
        const LowestModes modes = lowest_modes(a, dependent, {}, 8, true, true);
        ASSERT_TRUE(modes.converged);
        ASSERT_EQ(modes.value.size(), 8u);
        const Eigen::MatrixXd whole = dense(a);
        const Eigen::VectorXd lambda = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(whole).eigenvalues();
        // The independent columns are chosen exactly, so they can be nearly dependent: then the vectors (not the
        // values, which are Rayleigh quotients) lose digits with the condition number of what is factorised.
        const double residual = smallest_independent(whole, dependent) > 1e-9 * lambda.maxCoeff() ? 1e-9 : 1e-6;
        Eigen::MatrixXd u(a.size, 8);
        for (Eigen::Index m = 0; m < 8; ++m) {
          const auto k = static_cast<std::size_t>(m);
          EXPECT_NEAR(modes.value[k] / lambda[zero + m], 1, 1e-6) << z << ' ' << zero;
          u.col(m) = Eigen::Map<const Eigen::VectorXd>(modes.vector[k].data(), a.size);
          EXPECT_LT((whole * u.col(m) - modes.value[k] * u.col(m)).norm(), residual * lambda.maxCoeff());
        }
        EXPECT_LT((u.transpose() * u - Eigen::MatrixXd::Identity(8, 8)).norm(), 1e3 * residual);
      }
}

// A gas of equal pairs: G of a frictionless pair is (-n, n), one singular value sqrt(2), as often as there are pairs.
TEST(LooseModes, GasOfEqualPairsKeepsMultiplicities) {
  Packing<2> gas;
  gas.cell = PeriodicCell<2>({{200.0, 200.0}});
  for (int k = 0; k < 1400; ++k) {
    gas.bodies.id.push_back(k);
    gas.bodies.position.push_back({{(k / 2 % 30) * 5.0 + k % 2, (k / 60) * 5.0}});
    gas.bodies.radius.push_back(0.5);
    if (k % 4 != 1) continue;
    Link<2> link;
    link.i = k - 1, link.j = k;
    gas.links.push_back(link);
  }
  const auto sigma = smallest_singular_values(gas, NetworkLaw::frictionless, false, 6);
  ASSERT_EQ(sigma.size(), 6u);
  for (double s : sigma) EXPECT_NEAR(s, std::sqrt(2.0), 1e-14);
}

TEST(NullSpace, ProjectsLikeADenseBasis) {
  constexpr Eigen::Index kSize = 40, kDimension = 9;
  Eigen::MatrixXd n = Eigen::MatrixXd::Random(kSize, kDimension);
  n.topRows(kDimension).setIdentity();
  n.block(kDimension, 0, 20, 4).setZero();  // vectors of two kinds that share no row below the identity
  n.block(kDimension + 20, 4, kSize - kDimension - 20, kDimension - 4).setZero();
  const NullSpace space(kSize, kDimension, [&](std::size_t k) {
    const Eigen::VectorXd column = n.col(static_cast<Eigen::Index>(k));
    return std::vector<double>(column.data(), column.data() + kSize);
  });
  EXPECT_EQ(space.entries(), static_cast<std::size_t>(kDimension + 4 * (kSize - kDimension - 20) + 5 * 20));
  const Eigen::VectorXd x = Eigen::VectorXd::Random(kSize);
  const Eigen::VectorXd expected = x - n * n.colPivHouseholderQr().solve(x);
  std::vector<double> y(x.data(), x.data() + kSize);
  space.project_out(y);
  EXPECT_LT((Eigen::Map<const Eigen::VectorXd>(y.data(), kSize) - expected).norm(), 1e-13 * x.norm());
}

// Supernodal CHOLMOD and UMFPACK know OpenMP; a run stays one thread.
TEST(Threads, FactorisationStartsNone) {
  if (std::getenv("OMP_NUM_THREADS") != nullptr) GTEST_SKIP() << "OMP_NUM_THREADS asks for a number of threads";
  const auto threads = [] {
    const std::filesystem::directory_iterator tasks("/proc/self/task");
    return std::distance(begin(tasks), end(tasks));
  };
  const auto before = threads();
  const Packing<2> p = loose(3, 5.0, 60);
  const SymmetricMatrix a = unit_stiffness(p, NetworkLaw::friction, false);
  const LowestModes modes = lowest_modes(a, dependent_columns(p, NetworkLaw::friction, false), {}, 2, true, false);
  EXPECT_TRUE(modes.converged);
  EXPECT_EQ(threads(), before);
}

}  // namespace
}  // namespace isostat
