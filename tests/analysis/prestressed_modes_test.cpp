// Modes of the full tangent. Oracles: finite differences of the net loads of moved packings, and dense eigenvalues.
#include "analysis/stiffness/prestressed_modes.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "analysis/stiffness/link_tangent.hpp"
#include "analysis/stiffness/stiffness_matrix.hpp"
#include "analysis/stiffness/vibration.hpp"
#include "tests/oracle/network_oracle.hpp"
#include "tests/support/random_network.hpp"

namespace isostat {
namespace {

using Complexes = std::vector<std::complex<double>>;

DiskLaw soft_law() {
  DiskLaw law = default_network_law();
  law.normal_stiffness = 20, law.tangential_stiffness = 12, law.rolling_stiffness = 0.7;
  return law;
}

Packing<2> loaded(std::uint64_t seed, int size, double z, double normal, double tangential) {
  RandomNetwork o;
  o.columns = o.rows = size, o.seed = seed, o.coordination = z, o.sliding = o.rolling_yielded = 0.1;
  Packing<2> p = random_network(o);
  for (std::size_t l = 0; l < p.links.size(); ++l) {
    const double phase = static_cast<double>(l + seed);
    p.links[l].normal_force = normal * (1 + std::sin(3 * phase));
    p.links[l].tangential_force = tangential * std::sin(5 * phase);
    p.links[l].moment = 0.1 * tangential * std::sin(7 * phase);
  }
  return p;
}

// Moves one dof of one body: forces follow the law of their rows, in the frame that has turned.
Packing<2> moved(const Packing<2>& p, NetworkLaw network_law, const DiskLaw& law, std::size_t body, int dof,
                 double by) {
  Packing<2> q = p;
  if (dof < 2) q.bodies.position[body][static_cast<std::size_t>(dof)] += by;
  for (Link<2>& link : q.links) {
    const auto i = static_cast<std::size_t>(link.i), j = static_cast<std::size_t>(link.j);
    const auto branch = [&](const Packing<2>& of) {
      return of.bodies.position[j] - of.bodies.position[i] + of.cell->offset(link.shift);
    };
    const Vec2 before = branch(p), after = branch(q), step = after - before;
    const double r = std::hypot(before[0], before[1]);
    const LinkRows rows = rows_of(link.kind, network_law);
    const double spin_i = dof == 2 && i == body ? by : 0, spin_j = dof == 2 && j == body ? by : 0;
    const double ri = p.bodies.radius[i], rj = p.bodies.radius[j], lever = r / (ri + rj);
    link.normal_force -= law.normal_stiffness * (std::hypot(after[0], after[1]) - r);
    if (rows.tangential)
      link.tangential_force -= law.tangential_stiffness *
                               ((-before[1] * step[0] + before[0] * step[1]) / r - lever * (ri * spin_i + rj * spin_j));
    if (rows.rolling) link.moment -= law.rolling_stiffness * (spin_j - spin_i);
  }
  return q;
}

Eigen::MatrixXd dense(const UnsymmetricMatrix& a) {
  Eigen::MatrixXd d = Eigen::MatrixXd::Zero(a.size, a.size);
  for (std::int32_t c = 0; c < a.size; ++c)
    for (auto e = static_cast<std::size_t>(a.start[static_cast<std::size_t>(c)]);
         e < static_cast<std::size_t>(a.start[static_cast<std::size_t>(c) + 1]); ++e)
      d(a.row[e], c) = a.value[e];
  return d;
}

// All eigenvalues of M^-1 T by dense QR, without the `held` nearest to zero, ascending magnitude.
Complexes dense_spectrum(Eigen::MatrixXd t, const std::vector<double>& mass, std::size_t held) {
  for (Eigen::Index r = 0; r < t.rows(); ++r) t.row(r) /= mass[static_cast<std::size_t>(r)];
  const Eigen::VectorXcd values = Eigen::EigenSolver<Eigen::MatrixXd>(t, false).eigenvalues();
  Complexes all(values.data(), values.data() + values.size());
  std::stable_sort(all.begin(), all.end(), [](auto a, auto b) { return std::abs(a) < std::abs(b); });
  return {all.begin() + static_cast<std::ptrdiff_t>(held), all.end()};
}

TEST(TangentStiffness, EqualsFiniteDifferencesOfTheNetLoads) {
  const DiskLaw law = soft_law();
  for (const NetworkLaw network_law : {NetworkLaw::friction, NetworkLaw::rolling})
    for (std::uint64_t seed = 1; seed < 4; ++seed) {
      const Packing<2> p = loaded(seed, 4, 4.0, 3, 2);
      const Eigen::MatrixXd t = dense(tangent_stiffness(p, network_law, law));
      const double step = 1e-5;
      for (std::size_t c = 0; c < static_cast<std::size_t>(t.cols()); ++c) {
        const auto up = oracle::net_loads(moved(p, network_law, law, c / 3, static_cast<int>(c % 3), step));
        const auto down = oracle::net_loads(moved(p, network_law, law, c / 3, static_cast<int>(c % 3), -step));
        for (std::size_t i = 0; i < up.size(); ++i) {
          const double change[] = {up[i].force[0] - down[i].force[0], up[i].force[1] - down[i].force[1],
                                   up[i].moment - down[i].moment};
          for (std::size_t d = 0; d < 3; ++d)
            EXPECT_NEAR(t(static_cast<Eigen::Index>(3 * i + d), static_cast<Eigen::Index>(c)), -change[d] / (2 * step),
                        1e-7 * law.normal_stiffness);
        }
      }
    }
}

// Dense pieces and Arnoldi on large ones, weak prestress (real omega^2) and strong tangential forces (complex).
TEST(PrestressedModes, EqualTheDenseSpectrum) {
  const DiskLaw law = soft_law();
  bool complex_seen = false, arnoldi_seen = false, dense_seen = false;
  for (const int size : {6, 10})
    for (const double tangential : {0.2, 6.0})
      for (const NetworkLaw network_law : {NetworkLaw::frictionless, NetworkLaw::friction, NetworkLaw::rolling}) {
        const Packing<2> p = loaded(5, size, 5.0, 0.5, tangential);
        const auto modes = prestressed_modes(p, network_law, law, 12);
        ASSERT_EQ(modes.pieces, 1);
        ASSERT_TRUE(modes.converged);
        (modes.shift < 0 ? arnoldi_seen : dense_seen) = true;
        const Complexes expected =
            dense_spectrum(dense(tangent_stiffness(p, network_law, law)), dof_masses(p, network_law),
                           static_cast<std::size_t>(modes.unlinked_dofs) + 2);
        const double scale = std::abs(expected.back());
        ASSERT_GE(modes.omega_squared.size(), 12u);
        for (std::size_t k = 0; k < modes.omega_squared.size(); ++k) {
          EXPECT_NEAR(std::abs(modes.omega_squared[k]), std::abs(expected[k]), 1e-9 * scale);
          const double nearest = std::abs(*std::min_element(expected.begin(), expected.end(), [&](auto a, auto b) {
            return std::abs(a - modes.omega_squared[k]) < std::abs(b - modes.omega_squared[k]);
          }) - modes.omega_squared[k]);
          EXPECT_LT(nearest, 1e-9 * scale);
          EXPECT_LT(modes.residual[k], 1e-9);
          complex_seen = complex_seen || std::abs(modes.omega_squared[k].imag()) > 1e-5 * scale;
        }
        EXPECT_GT(modes.antisymmetric_part, 1e-6);
      }
  EXPECT_TRUE(complex_seen && arnoldi_seen && dense_seen);
}

TEST(PrestressedModes, WithoutForcesTheyAreTheSymmetricOnes) {
  const DiskLaw law = soft_law();
  for (const int size : {5, 12}) {
    const Packing<2> p = loaded(3, size, 5.5, 0, 0);
    const VibrationModes symmetric = vibration_modes(p, NetworkLaw::rolling, law, 8, false);
    const PrestressedModes full = prestressed_modes(p, NetworkLaw::rolling, law, 8);
    ASSERT_EQ(symmetric.zero_modes, 2 + full.unlinked_dofs);
    EXPECT_LT(full.antisymmetric_part, 1e-14);
    for (std::size_t k = 0; k < 8; ++k) {
      EXPECT_NEAR(full.omega_squared[k].real() / std::pow(symmetric.omega[k], 2), 1, 1e-8);
      EXPECT_NEAR(full.omega_squared[k].imag(), 0, 1e-8 * full.omega_squared[k].real());
    }
  }
}

// Two grains in a row through the period under a thrust N, frictionless: sideways the row buckles. By hand: two links
// of length d = 1 hold m_1 and m_2, omega^2 = -(2 N / d)(1 / m_1 + 1 / m_2) sideways, 2 K_N (1 / m_1 + 1 / m_2) along.
TEST(PrestressedModes, RowUnderThrustBuckles) {
  Packing<2> p;
  p.cell = PeriodicCell<2>{{{2.0, 2.0}}};
  p.bodies.resize(2);
  for (std::size_t k = 0; k < 2; ++k) {
    p.bodies.position[k] = {{static_cast<double>(k), 0.0}};
    p.bodies.radius[k] = 0.5, p.bodies.mass[k] = 1 + static_cast<double>(k), p.bodies.inertia[k] = 0.1;
  }
  for (int s = 0; s < 2; ++s) {
    Link<2> link;
    link.i = s, link.j = 1 - s, link.shift = {s, 0}, link.normal_force = 0.3;
    p.links.push_back(link);
  }
  const PrestressedModes modes = prestressed_modes(p, NetworkLaw::frictionless, soft_law(), 5);
  ASSERT_EQ(modes.omega_squared.size(), 2u);
  EXPECT_NEAR(modes.omega_squared[0].real(), -0.6 * 1.5, 1e-13);
  EXPECT_NEAR(modes.omega_squared[1].real(), 40 * 1.5, 1e-12);
}

}  // namespace
}  // namespace isostat
