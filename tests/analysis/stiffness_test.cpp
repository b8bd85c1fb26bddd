#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/rigidity/exact_rank.hpp"
#include "analysis/rigidity/independent_columns.hpp"
#include "analysis/rigidity/sections.hpp"
#include "analysis/stiffness/bases.hpp"
#include "analysis/stiffness/lowest_modes.hpp"
#include "analysis/stiffness/moduli.hpp"
#include "analysis/stiffness/soft_modes.hpp"
#include "analysis/stiffness/stiffness_matrix.hpp"
#include "analysis/stiffness/vibration.hpp"
#include "dem/files/network_file.hpp"
#include "dem/input_error.hpp"
#include "tests/support/random_network.hpp"
#include "tests/support/refusal.hpp"

namespace isostat {
namespace {

constexpr NetworkLaw kLaws[] = {NetworkLaw::frictionless, NetworkLaw::friction, NetworkLaw::rolling};

Packing<2> cluster(const char* name) {
  return read_network<2>(std::string(ISOSTAT_DATA "/clusters/") + name + ".net").packing;
}

Eigen::MatrixXd dense(const RigidityMatrix& g) {
  Eigen::MatrixXd d = Eigen::MatrixXd::Zero(g.rows(), g.columns());
  for (Eigen::Index r = 0; r < g.rows(); ++r)
    for (auto e = g.row_start[static_cast<std::size_t>(r)]; e < g.row_start[static_cast<std::size_t>(r) + 1]; ++e)
      d(r, g.column[static_cast<std::size_t>(e)]) = g.value[static_cast<std::size_t>(e)];
  return d;
}

Packing<2> network(std::uint64_t seed, double z = 3.6, int size = 6) {
  RandomNetwork o;
  o.columns = o.rows = size, o.seed = seed, o.coordination = z, o.periodic = seed % 2 == 0;
  o.sliding = o.rolling_yielded = 0.05;
  return random_network(o);
}

TEST(IndependentColumns, AreIndependentAndComplete) {
  for (std::uint64_t seed = 0; seed < 20; ++seed)
    for (const NetworkLaw law : kLaws) {
      const Packing<2> p = network(seed, 2.5 + 0.1 * static_cast<double>(seed));
      const bool cell_free = p.cell && seed % 4 == 0;
      const auto dependent = dependent_columns(p, law, cell_free);
      const auto k = std::count(dependent.begin(), dependent.end(), 1);
      EXPECT_EQ(k, exact_rank(p, law, cell_free).floppy);
      const Eigen::MatrixXd g = dense(rigidity_matrix(p, law, cell_free));
      Eigen::MatrixXd kept(g.rows(), g.cols() - k);
      for (Eigen::Index c = 0, to = 0; c < g.cols(); ++c)
        if (!dependent[static_cast<std::size_t>(c)]) kept.col(to++) = g.col(c);
      if (kept.cols() > 0) {
        EXPECT_GT(Eigen::JacobiSVD<Eigen::MatrixXd>(kept).singularValues().minCoeff(), 1e-9);
      }
    }
}

TEST(StiffnessMatrix, EqualsDenseProduct) {
  const Packing<2> p = network(2);
  const DiskLaw law = default_network_law();
  const RigidityMatrix g = rigidity_matrix(p, NetworkLaw::rolling, true);
  const auto k = row_stiffness(p, g, law);
  const SymmetricMatrix a = weighted_normal_matrix(g, k);
  const Eigen::MatrixXd d = dense(g);
  const Eigen::MatrixXd expected =
      d.transpose() * Eigen::Map<const Eigen::VectorXd>(k.data(), static_cast<Eigen::Index>(k.size())).asDiagonal() * d;
  Eigen::MatrixXd got = Eigen::MatrixXd::Zero(a.size, a.size);
  for (std::int32_t c = 0; c < a.size; ++c)
    for (auto e = static_cast<std::size_t>(a.start[static_cast<std::size_t>(c)]);
         e < static_cast<std::size_t>(a.start[static_cast<std::size_t>(c) + 1]); ++e)
      got(a.row[e], c) = got(c, a.row[e]) = a.value[e];
  EXPECT_LT((got - expected).norm(), 1e-14 * expected.norm());
}

TEST(LowestModes, LanczosEqualsDense) {
  for (std::uint64_t seed : {2u, 4u}) {
    const Packing<2> p = network(seed, 4.2, 14);  // 588 columns: the sparse way
    const RigidityMatrix g = rigidity_matrix(p, NetworkLaw::friction, false);
    const auto k = row_stiffness(p, g, default_network_law());
    const SymmetricMatrix a = weighted_normal_matrix(g, k);
    ASSERT_GT(a.size, kDenseSize);
    const auto dependent = dependent_columns(p, NetworkLaw::friction, false);
    const LowestModes modes = lowest_modes(a, dependent, {}, 8, true, true);
    ASSERT_TRUE(modes.converged);
    const Eigen::MatrixXd d = dense(g);
    const Eigen::MatrixXd full =
        d.transpose() * Eigen::Map<const Eigen::VectorXd>(k.data(), static_cast<Eigen::Index>(k.size())).asDiagonal() *
        d;
    const Eigen::VectorXd lambda = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(full).eigenvalues();
    const auto zero = std::count(dependent.begin(), dependent.end(), 1);
    for (std::size_t m = 0; m < modes.value.size(); ++m) {
      EXPECT_NEAR(modes.value[m] / lambda[zero + static_cast<Eigen::Index>(m)], 1, 1e-6);
      const auto av = a.multiply(modes.vector[m]);
      double residual = 0;
      for (std::size_t i = 0; i < av.size(); ++i)
        residual = std::max(residual, std::abs(av[i] - modes.value[m] * modes.vector[m][i]));
      EXPECT_LT(residual, 1e-9 * lambda.maxCoeff());
    }
  }
}

// A periodic square lattice of disks of diameter d: contacts along x and y.
// e11 stretches the x contacts only: C11 = K_N, C12 = 0. gamma12 with spins relaxed (by symmetry w = 0 in the symmetric
// shear): each contact slides by gamma d / 2, energy K_T (gamma d / 2)^2 / 2 times two contacts a disk: C33 = K_T / 2.
TEST(Moduli, SquareLattice) {
  const Packing<2> p = cluster("periodic_square3x3");
  DiskLaw law = default_network_law();
  law.normal_stiffness = 7, law.tangential_stiffness = 3;
  const Moduli c = elastic_moduli(p, NetworkLaw::friction, law);
  const double expected[3][3] = {{7, 0, 0}, {0, 7, 0}, {0, 0, 1.5}};
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      EXPECT_NEAR(c[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)], expected[a][b], 7e-12);
  const Moduli loose = elastic_moduli(p, NetworkLaw::frictionless, law);
  EXPECT_NEAR(loose[0][0], 7, 7e-12);
  EXPECT_NEAR(loose[2][2], 0, 7e-12);
}

// Triangular lattice: all affine by symmetry. Sum over three bond directions at 0, 60, 120 degrees, cell area per disk
// sqrt(3)/2 d^2: C11 = (sqrt(3)/4)(3 K_N + K_T), C12 = (sqrt(3)/4)(K_N - K_T), C33 = (sqrt(3)/4)(K_N + K_T).
TEST(Moduli, TriangularLattice) {
  const Packing<2> p = cluster("periodic_triangular4");
  DiskLaw law = default_network_law();
  law.normal_stiffness = 5, law.tangential_stiffness = 2;
  const Moduli c = elastic_moduli(p, NetworkLaw::friction, law);
  const double q = std::sqrt(3.0) / 4;
  EXPECT_NEAR(c[0][0], q * 17, 1e-11);
  EXPECT_NEAR(c[1][1], q * 17, 1e-11);
  EXPECT_NEAR(c[0][1], q * 3, 1e-11);
  EXPECT_NEAR(c[2][2], q * 7, 1e-11);
  EXPECT_NEAR(c[0][2], 0, 1e-11);
  const Moduli central = elastic_moduli(p, NetworkLaw::frictionless, law);  // Cauchy: C12 = C33
  EXPECT_NEAR(central[0][1], q * 5, 1e-11);
  EXPECT_NEAR(central[2][2], q * 5, 1e-11);
}

// No grain of a Bravais lattice leaves the affine motion; the shares follow from the closed form above: for e11 = e22 =
// 1 every bond is shortened alike, for gamma12 three quarters of the bonds' energy K_N and a share K_T as C33 says.
TEST(Moduli, EnergyOfTheTriangularLattice) {
  const Packing<2> p = cluster("periodic_triangular4");
  DiskLaw law = default_network_law();
  law.normal_stiffness = 5, law.tangential_stiffness = 2;
  const ElasticResponse<3> c = elastic_response(p, NetworkLaw::friction, law);
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b) EXPECT_NEAR(c.affine[a][b], c.tensor[a][b], 1e-11);
  const std::vector<bool> contact(p.links.size(), true);
  const EnergyShares bulk = energy_shares(c, contact, {{1, 1, 0}});
  EXPECT_NEAR(bulk.normal, 1, 1e-12);
  EXPECT_NEAR(bulk.participation, 1, 1e-12);
  const EnergyShares shear = energy_shares(c, contact, {{0, 0, 1}});
  EXPECT_NEAR(shear.normal, 5.0 / 7, 1e-12);
  EXPECT_NEAR(shear.tangential, 2.0 / 7, 1e-12);
  EXPECT_EQ(shear.rolling, 0);
}

// The energy of the links is the work of the stress, 1/2 e C e A; holding the grains only stiffens.
TEST(Moduli, EnergyIsTheWorkOfTheStrain) {
  for (std::uint64_t seed : {2u, 6u, 8u}) {
    const Packing<2> p = network(seed, 4.0);
    const ElasticResponse<3> c = elastic_response(p, NetworkLaw::rolling, default_network_law());
    const std::array<double, 3> strain{0.3, -0.7, 0.4};
    double work = 0, energy = 0;
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = 0; b < 3; ++b) work += 0.5 * strain[a] * c.tensor[a][b] * strain[b] * p.cell->measure();
    for (std::size_t r = 0; r < c.k.size(); ++r) {
      double v = 0;
      for (std::size_t a = 0; a < 3; ++a) v += strain[a] * c.velocity[a][r];
      energy += 0.5 * c.k[r] * v * v;
    }
    EXPECT_NEAR(energy / work, 1, 1e-9);
    for (std::size_t a = 0; a < 3; ++a) EXPECT_GT(c.affine[a][a], c.tensor[a][a]);
    std::vector<bool> contact;
    for (const Link<2>& link : p.links) contact.push_back(link.kind != LinkKind::distant);
    const EnergyShares e = energy_shares(c, contact, {strain});
    EXPECT_NEAR(e.normal + e.tangential + e.rolling + e.distant, 1, 1e-12);
    EXPECT_GT(e.rolling, 0);
    EXPECT_LT(e.participation, 1);
  }
}

// Without forces the geometric term is absent: UMFPACK on the tangent against CHOLMOD on Gt k G.
TEST(Moduli, TangentWithoutForcesIsTheSymmetricOne) {
  for (std::uint64_t seed : {2u, 6u, 8u}) {
    const Packing<2> p = network(seed, 5.0);
    ASSERT_EQ(exact_rank(p, NetworkLaw::rolling, false).mechanisms, 0);
    const DiskLaw law = default_network_law();
    const Moduli symmetric = elastic_moduli(p, NetworkLaw::rolling, law);
    const TangentModuli tangent = tangent_moduli(p, NetworkLaw::rolling, law);
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = 0; b < 3; ++b) EXPECT_NEAR(tangent.tensor[a][b], symmetric[a][b], 1e-9 * symmetric[0][0]);
    EXPECT_LT(tangent.antisymmetric_part, 1e-12);
  }
}

// Two disks bound by one contact: omega^2 = K_N / reduced mass along the normal; sliding turns both disks.
TEST(Vibration, PairOfDisks) {
  const Packing<2> p = cluster("pair");
  DiskLaw law = default_network_law();
  law.normal_stiffness = 3, law.tangential_stiffness = 2;
  const VibrationModes modes = vibration_modes(p, NetworkLaw::friction, law, 5, true);
  EXPECT_EQ(modes.zero_modes, 4);
  ASSERT_EQ(modes.omega.size(), 2u);
  const double inverse_mass = 1 / p.bodies.mass[0] + 1 / p.bodies.mass[1];
  const double normal = std::sqrt(3 * inverse_mass);
  const double li = 0.5, lj = 0.4;
  const double sliding = std::sqrt(2 * (inverse_mass + li * li / p.bodies.inertia[0] + lj * lj / p.bodies.inertia[1]));
  EXPECT_NEAR(modes.omega[0], std::min(normal, sliding), 1e-12);
  EXPECT_NEAR(modes.omega[1], std::max(normal, sliding), 1e-12);
  // Along the normal m_i v_i = -m_j v_j: shares of energy are as the other's mass.
  const std::size_t along = normal < sliding ? 0 : 1;
  const double share = p.bodies.mass[1] / (p.bodies.mass[0] + p.bodies.mass[1]);
  EXPECT_NEAR(modes.participation[along], 1 / (2 * (share * share + (1 - share) * (1 - share))), 1e-12);
}

// All modes of a network that Lanczos would take, against a dense solver of the generalised problem.
TEST(Vibration, AllModesAreThoseOfTheDenseMatrix) {
  const Packing<2> p = network(2, 4.4, 12);
  const DiskLaw law = default_network_law();
  const VibrationModes modes = vibration_modes(p, NetworkLaw::friction, law, kAllModes, true);
  const RigidityMatrix g = rigidity_matrix(p, NetworkLaw::friction, false);
  ASSERT_GT(g.columns(), 3 * kDenseSize / 2);
  const auto k = row_stiffness(p, g, law);
  const Eigen::MatrixXd dense_g = dense(g);
  const Eigen::MatrixXd stiffness =
      dense_g.transpose() * Eigen::Map<const Eigen::VectorXd>(k.data(), std::ssize(k)).asDiagonal() * dense_g;
  const std::vector<double> m = dof_masses(p, NetworkLaw::friction);
  const Eigen::VectorXd mass = Eigen::Map<const Eigen::VectorXd>(m.data(), std::ssize(m));
  const Eigen::VectorXd root = mass.cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(root.asDiagonal() * stiffness * root.asDiagonal());
  ASSERT_EQ(std::ssize(modes.omega) + modes.zero_modes, g.columns());
  const double largest = solver.eigenvalues().maxCoeff();
  for (Eigen::Index i = 0; i < std::ssize(modes.omega); ++i) {
    const auto n = static_cast<std::size_t>(i);
    EXPECT_NEAR(modes.omega[n] * modes.omega[n], solver.eigenvalues()[modes.zero_modes + i], 1e-12 * largest);
    const Eigen::Map<const Eigen::VectorXd> u(modes.displacement[n].data(), g.columns());
    EXPECT_NEAR(u.dot(mass.cwiseProduct(u)), 1, 1e-12);
    EXPECT_LT((stiffness * u - modes.omega[n] * modes.omega[n] * mass.cwiseProduct(u)).cwiseAbs().maxCoeff(),
              1e-11 * largest);
    double squares = 0;
    for (Eigen::Index b = 0; b < g.columns(); b += 3) {
      const double share = u.segment(b, 3).dot(mass.segment(b, 3).cwiseProduct(u.segment(b, 3)));
      squares += share * share;
    }
    EXPECT_NEAR(modes.participation[n], 3 / (static_cast<double>(g.columns()) * squares), 1e-12);
  }
}

TEST(SoftModes, SmallestSingularValueOfAnOverlappingTriangle) {
  // Dense reference with the same scaling of spins.
  const Packing<2> p = cluster("double_triangle_overlap");
  Eigen::MatrixXd g = dense(rigidity_matrix(p, NetworkLaw::friction, false));
  for (Eigen::Index i = 0; i < 4; ++i) g.col(3 * i + 2) /= p.bodies.radius[static_cast<std::size_t>(i)];
  const Eigen::VectorXd sigma = Eigen::JacobiSVD<Eigen::MatrixXd>(g).singularValues();
  const auto found = smallest_singular_values(p, NetworkLaw::friction, false, 3);
  ASSERT_EQ(found.size(), 3u);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(found[static_cast<std::size_t>(k)], sigma[8 - k], 1e-10);
}

TEST(RigiditySections, FollowTheContract) {
  AnalysisInput input;
  input.path = "k23.net";
  input.state.packing = cluster("k23");
  const auto rigidity = rigidity_section(input, {});
  for (const char* key :
       {"law", "cell", "N_f", "M", "rank", "H", "K", "trivial", "rattler_modes", "mechanisms", "method", "certificate"})
    EXPECT_TRUE(rigidity.contains(key)) << key;
  EXPECT_EQ(rigidity["K"], 4);
  EXPECT_EQ(rigidity["H"], 1);
  EXPECT_EQ(rigidity["certificate"]["gear_components"].size(), 1u);
  EXPECT_GT(rigidity["certificate"]["near_null_singular_values"]["values"][0].get<double>(), 0.01);
  EXPECT_EQ(clusters_section(input, {})["sizes"].size(), 0u);
  const auto stiffness = stiffness_section(input, {});
  EXPECT_EQ(stiffness["inertia"], nlohmann::ordered_json::parse("[0, 4, 11]"));
  EXPECT_EQ(stiffness["positive_definite"], false);
  EXPECT_EQ(oracle::refusal(input, "moduli"), "needs a periodic cell: elastic moduli are those of its strains");
}

TEST(RigiditySections, RowsWithoutStiffnessAreRefused) {
  AnalysisInput input;
  input.path = "state.h5";
  input.state.packing = cluster("k23");
  input.state.law.normal_stiffness = 1e5;
  AnalysisOptions options;
  EXPECT_EQ(oracle::refusal(input, "stiffness"), "taken");  // a law without friction: no such rows
  options.law = NetworkLaw::rolling;
  EXPECT_EQ(oracle::refusal(input, "stiffness", options),
            "the law of the state has no tangential stiffness; use --law frictionless");
  input.state.law.tangential_stiffness = 1e5;
  EXPECT_EQ(oracle::refusal(input, "stiffness", options),
            "the law of the state has no rolling stiffness; use --law friction");
}

// Nothing that could be factorised is left: no link, or none whose rows are not zero (a grain linked to itself).
TEST(RigiditySections, PackingsWithoutAnIndependentColumn) {
  for (const char* text :
       {"grain 1 0 0 .5\n", "cell 3 3\ngrain 1 0 0 .5\n", "cell 9 9\ngrain 1 1 1 .5\ngrain 2 4 4 .4\ngrain 3 7 7 .5\n",
        "cell 1 1\ngrain 1 0 0 .5\ncontact 1 1 s 1 0\n"})
    for (const NetworkLaw law : kLaws) {
      SCOPED_TRACE(text);
      AnalysisInput input;
      input.path = "gas.net";
      input.state.packing = parse_network<2>(text, "gas.net").packing;
      AnalysisOptions options;
      options.law = law;
      const ExactRank rank = exact_rank(input.packing(), law, false);
      ASSERT_EQ(rank.rank, 0);
      const auto stiffness = stiffness_section(input, options);
      EXPECT_EQ(stiffness["inertia"], nlohmann::ordered_json({0, rank.dofs, 0}));
      EXPECT_EQ(stiffness["factor"]["columns"], 0);
      EXPECT_EQ(stiffness["factor"]["pivot_ratio"], 1);
      const auto modes = modes_section(input, options);
      EXPECT_EQ(modes["omega"].size(), 0u);
      EXPECT_EQ(modes["zero_modes"], rank.dofs);
      EXPECT_TRUE(smallest_singular_values(input.packing(), law, false, 3).empty());
      EXPECT_EQ(floppy_modes(input.packing(), law, false, 100).size(), static_cast<std::size_t>(rank.dofs));
      EXPECT_EQ(self_stress_states(input.packing(), law, false, 100).size(),
                static_cast<std::size_t>(rank.hyperstatic));
      EXPECT_EQ(bases_section(input, options)["floppy_modes"]["of"], rank.dofs);
      if (!input.packing().cell) continue;
      const auto moduli = moduli_section(input, options);
      EXPECT_FALSE(moduli.contains("failed"));
      if (input.packing().links.empty()) {
        EXPECT_EQ(moduli["tensor"],
                  nlohmann::ordered_json::parse("[[0.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]]"));
      }
    }
}

TEST(SparseCholesky, TakesMatricesWithoutColumnsOrEntries) {
  SymmetricMatrix none;
  none.start = {0};
  for (const auto form : {SparseCholesky::Form::definite, SparseCholesky::Form::indefinite}) {
    for (const SymmetricMatrix& empty : {none, SymmetricMatrix{}}) {
      const SparseCholesky factor(empty, form);
      EXPECT_EQ(factor.inertia(), (std::array<std::int64_t, 2>{0, 0}));
      EXPECT_EQ(factor.pivot_ratio(), 1);
      EXPECT_EQ(factor.factor_entries(), 0);
      EXPECT_TRUE(factor.solve({}).empty());
    }
    SymmetricMatrix zero;
    zero.size = 3, zero.start = {0, 0, 0, 0};
    EXPECT_THROW(SparseCholesky(zero, form), FactorisationFailed);
  }
}

TEST(RigiditySections, DistantLinksMakeTheStiffnessIndefinite) {
  // Two disks and a distant link alone: one negative direction.
  AnalysisInput input;
  input.path = "distant.net";
  input.state.packing = parse_network<2>("grain 0 0 0 .5\ngrain 1 1.0005 0 .5\ncontact 0 1 d\n", "distant.net").packing;
  EXPECT_EQ(stiffness_section(input, {})["inertia"], nlohmann::ordered_json::parse("[1, 5, 0]"));
}

}  // namespace
}  // namespace isostat
