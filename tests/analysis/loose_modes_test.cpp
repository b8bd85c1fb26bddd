// Modes of loose networks: thousands of zero modes, many pieces. Oracle: dense eigenvalues of the whole.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "analysis/rigidity/exact_rank.hpp"
#include "analysis/rigidity/independent_columns.hpp"
#include "analysis/stiffness/lowest_modes.hpp"
#include "analysis/stiffness/soft_modes.hpp"
#include "analysis/stiffness/stiffness_matrix.hpp"
#include "tests/support/random_network.hpp"
#include "tests/support/skip.hpp"

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
        constexpr double residual = 1e-9;
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

// A grain on a link between two others, held by links to both, off the line by the angle delta: it can leave the line
// at a cost of the second order, sigma = sqrt(2) delta if its neighbours stood still. Soft and not floppy, down to
// where sigma^2 is rounding. Oracle: singular values of G itself.
TEST(SoftModes, AreFoundBesideManyFloppyOnes) {
  for (const double delta : {1e-2, 1e-4, 1e-6}) {
    Packing<2> p = loose(11, 3.7, 15);
    const std::int32_t a = 0, b = 7, x = static_cast<std::int32_t>(p.bodies.size());
    const Vec2 from = p.bodies.position[0], along = p.bodies.position[7] - from;
    p.bodies.id.push_back(1000);
    p.bodies.position.push_back(from + 0.5 * along + (0.5 * delta) * Vec2{{-along[1], along[0]}});
    p.bodies.radius.push_back(0.5);
    for (const auto& [i, j] : {std::pair{a, b}, std::pair{x, a}, std::pair{x, b}}) {
      Link<2> link;
      link.i = i, link.j = j;
      p.links.push_back(link);
    }
    const RigidityMatrix g = rigidity_matrix(p, NetworkLaw::frictionless, false);
    ASSERT_GT(g.columns(), kDenseSize);
    Eigen::MatrixXd d = Eigen::MatrixXd::Zero(g.rows(), g.columns());
    for (Eigen::Index r = 0; r < g.rows(); ++r)
      for (auto e = static_cast<std::size_t>(g.row_start[static_cast<std::size_t>(r)]);
           e < static_cast<std::size_t>(g.row_start[static_cast<std::size_t>(r) + 1]); ++e)
        d(r, g.column[e]) += g.value[e];
    const Eigen::VectorXd sigma = Eigen::BDCSVD<Eigen::MatrixXd>(d).singularValues();
    const auto rank = static_cast<Eigen::Index>(exact_rank(p, NetworkLaw::frictionless, false).rank);
    EXPECT_GT(exact_rank(p, NetworkLaw::frictionless, false).mechanisms, 10);
    const auto found = smallest_singular_values(p, NetworkLaw::frictionless, false, 6);
    ASSERT_EQ(found.size(), 6u);
    for (Eigen::Index k = 0; k < 6; ++k) {
      const double expected = sigma[rank - 1 - k];
      // G^T G is formed: eps |A| of rounding in sigma^2
      EXPECT_NEAR(found[static_cast<std::size_t>(k)] / expected, 1, 1e-6 + 1e-14 / (expected * expected));
    }
    EXPECT_LT(found[0], 2 * delta);
  }
}

// Supernodal CHOLMOD and UMFPACK know OpenMP; a run stays one thread.
TEST(Threads, FactorisationStartsNone) {
  if (std::getenv("OMP_NUM_THREADS") != nullptr) ISOSTAT_SKIP("OMP_NUM_THREADS asks for a number of threads");
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
