#include "analysis/stiffness/bases.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "analysis/rigidity/exact_rank.hpp"
#include "analysis/rigidity/rigidity_matrix.hpp"
#include "dem/files/network_file.hpp"
#include "tests/support/random_network.hpp"

namespace isostat {
namespace {

Eigen::Index rank_of(const std::vector<NullVector>& vectors) {
  if (vectors.empty()) return 0;
  Eigen::MatrixXd m(static_cast<Eigen::Index>(vectors[0].value.size()), static_cast<Eigen::Index>(vectors.size()));
  for (std::size_t k = 0; k < vectors.size(); ++k)
    m.col(static_cast<Eigen::Index>(k)) =
        Eigen::Map<const Eigen::VectorXd>(vectors[k].value.data(), m.rows()).normalized();
  return Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(m).rank();
}

// The self-stress of the double triangle: N_common : N_outer : |T_outer| : T_common = -4 : 1 : sqrt(3) : 0.
TEST(SelfStress, DoubleTriangle) {
  const auto p = read_network<2>(ISOSTAT_DATA "/clusters/double_triangle.net").packing;
  const auto states = self_stress_states(p, NetworkLaw::friction, false, 10);
  ASSERT_EQ(states.size(), 1u);
  const auto& f = states[0].value;  // rows N, T of links 0-1 (common), then the four outer ones
  EXPECT_LT(states[0].residual, 1e-13);
  EXPECT_NEAR(f[1], 0, 1e-13);
  for (std::size_t l = 1; l < 5; ++l) {
    EXPECT_NEAR(f[2 * l] / f[0], -0.25, 1e-12);
    EXPECT_NEAR(std::abs(f[2 * l + 1] / f[2 * l]), std::sqrt(3.0), 1e-12);
  }
}

TEST(Bases, AreCompleteWithSmallResiduals) {
  for (std::uint64_t seed = 0; seed < 12; ++seed)
    for (const NetworkLaw law : {NetworkLaw::frictionless, NetworkLaw::friction, NetworkLaw::rolling}) {
      RandomNetwork o;
      o.columns = o.rows = 5, o.seed = seed, o.coordination = 2.5 + 0.15 * static_cast<double>(seed),
      o.periodic = seed % 2 == 0;
      const Packing<2> p = random_network(o);
      const ExactRank r = exact_rank(p, law, p.cell.has_value());
      const auto floppy = floppy_modes(p, law, p.cell.has_value(), 1000);
      const auto stress = self_stress_states(p, law, p.cell.has_value(), 1000);
      EXPECT_EQ(static_cast<std::int64_t>(floppy.size()), r.floppy);
      EXPECT_EQ(rank_of(floppy), r.floppy);
      EXPECT_EQ(static_cast<std::int64_t>(stress.size()), r.hyperstatic)
          << "seed " << seed << " law " << static_cast<int>(law);
      EXPECT_EQ(rank_of(stress), r.hyperstatic);
      for (const auto* list : {&floppy, &stress})
        for (const auto& v : *list) EXPECT_LT(v.residual, 1e-8);
    }
}

TEST(Bases, GearModeAndItsSelfStress) {
  const auto p = read_network<2>(ISOSTAT_DATA "/clusters/k23.net").packing;
  const auto stress = self_stress_states(p, NetworkLaw::friction, false, 10);
  ASSERT_EQ(stress.size(), 1u);  // on no rigid cluster
  EXPECT_LT(stress[0].residual, 1e-12);
  EXPECT_EQ(rank_of(floppy_modes(p, NetworkLaw::friction, false, 10)), 4);
}

TEST(Bases, ForcesSplitIntoLoadAndSelfStress) {
  RandomNetwork o;
  o.columns = o.rows = 6, o.coordination = 4.5;
  const Packing<2> p = random_network(o);
  const RigidityMatrix g = rigidity_matrix(p, NetworkLaw::friction, false);
  std::vector<double> f(static_cast<std::size_t>(g.rows()));
  for (std::size_t r = 0; r < f.size(); ++r) f[r] = std::cos(1.0 + static_cast<double>(r));
  const ForceSplit split = split_forces(p, NetworkLaw::friction, false, f);
  EXPECT_LT(split.residual, 1e-12);
  const auto load = g.body_forces(f), balanced = g.body_forces(split.balancing);
  double product = 0, size = 0;
  for (std::size_t r = 0; r < f.size(); ++r)
    product += split.balancing[r] * split.self_stress[r], size += std::abs(split.self_stress[r]);
  EXPECT_NEAR(product, 0, 1e-11);
  EXPECT_GT(size, 1.0);
  for (std::size_t c = 0; c < load.size(); ++c) EXPECT_NEAR(load[c], balanced[c], 1e-12);
}

}  // namespace
}  // namespace isostat
