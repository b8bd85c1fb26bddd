// G of spheres in doubles, and what stands on it: virtual work, rigid motions, dense references of null spaces,
// singular values, stiffness, moduli and modes.
#include "analysis/stiffness/sphere_stiffness.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>
#include <set>

#include "analysis/rigidity/clusters.hpp"
#include "analysis/rigidity/exact_rank.hpp"
#include "analysis/rigidity/independent_columns.hpp"
#include "analysis/rigidity/rigid_spheres.hpp"
#include "analysis/rigidity/sphere_rows.hpp"
#include "analysis/stiffness/bases.hpp"
#include "analysis/stiffness/soft_modes.hpp"
#include "dem/state/balance_3d.hpp"
#include "dem/state/link_ends.hpp"
#include "geometry/base/index.hpp"
#include "tests/support/random_spheres.hpp"

namespace isostat {
namespace {

using Matrix = Eigen::MatrixXd;

constexpr NetworkLaw kLaws[] = {NetworkLaw::frictionless, NetworkLaw::friction, NetworkLaw::rolling};

Matrix dense(const RigidityMatrix& g) {
  Matrix m = Matrix::Zero(g.rows(), g.columns());
  for (std::int64_t r = 0; r < g.rows(); ++r)
    for (std::int64_t e = g.row_start[idx(r)]; e < g.row_start[idx(r) + 1]; ++e)
      m(r, g.column[idx(e)]) += g.value[idx(e)];
  return m;
}
Matrix dense(const SymmetricMatrix& a) {
  Matrix m = Matrix::Zero(a.size, a.size);
  for (std::int32_t c = 0; c < a.size; ++c)
    for (std::int32_t e = a.start[idx(c)]; e < a.start[idx(c) + 1]; ++e)
      m(a.row[idx(e)], c) = m(c, a.row[idx(e)]) = a.value[idx(e)];
  return m;
}

Packing<3> network(std::uint64_t seed, double coordination = 6, bool periodic = true,
                   std::array<int, 3> size = {3, 3, 2}, double mixed = 0) {
  RandomSpheres o;
  o.size = size, o.coordination = coordination, o.periodic = periodic, o.seed = seed;
  o.distant = o.sliding = o.rolling_yielded = o.both_yielded = mixed;
  return random_spheres(o);
}

void set_forces(Packing<3>& p, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<> normal;
  for (Link<3>& link : p.links) {
    const Vec3 n{frame(ends(p, link)).n};
    link.normal_force = normal(random);
    link.tangential_force = link.moment = {};
    const SphereRows rows = sphere_rows(link.kind, NetworkLaw::rolling);
    if (rows.contact) {
      link.tangential_force = {{normal(random), normal(random), normal(random)}};
      link.tangential_force -= dot(link.tangential_force, n) * n;
    }
    if (rows.rolling) link.moment = {{normal(random), normal(random), normal(random)}};
  }
}

TEST(SphereMatrix, TransposeGivesTheNetLoads) {
  for (const bool periodic : {true, false}) {
    Packing<3> p = network(2, 7, periodic, {3, 2, 2}, 0.1);
    set_forces(p, 9);
    const RigidityMatrix g = rigidity_matrix(SphereNetwork(p), NetworkLaw::rolling, periodic);
    const auto f = link_forces(SphereNetwork(p), g), on_bodies = g.body_forces(f);
    const auto loads = net_loads(p);
    for (std::size_t i = 0; i < loads.size(); ++i)
      for (int k = 0; k < 3; ++k) {
        EXPECT_NEAR(on_bodies[6 * i + idx(k)], loads[i].force[k], 1e-12);
        EXPECT_NEAR(on_bodies[6 * i + 3 + idx(k)], loads[i].moment[k], 1e-12);
      }
    if (periodic) {
      const StressTensor3 s = measured_stress(p);  // work-conjugate of the strains: minus volume times stress
      for (int a = 0; a < 3; ++a)
        EXPECT_NEAR(on_bodies[idx(g.layout.strain_column(a))], -p.cell->measure() * s[idx(a)][a], 1e-11);
    }
    // And back: forces by link from forces by row.
    const SphereForces back = by_link(SphereNetwork(p), g, f);
    for (std::size_t l = 0; l < p.links.size(); ++l) {
      EXPECT_NEAR(back.normal[l], p.links[l].normal_force, 1e-13);
      for (int k = 0; k < 3; ++k) {
        EXPECT_NEAR(back.tangential[l][k], p.links[l].tangential_force[k], 1e-13);
        EXPECT_EQ(back.moment[l][k], p.links[l].moment[k]);
      }
    }
  }
}

TEST(SphereMatrix, RowsInContactFramesAreTurned) {
  const Packing<3> p = network(4, 6, true, {2, 2, 3}, 0.1);
  const RigidityMatrix g = rigidity_matrix(SphereNetwork(p), NetworkLaw::rolling, true),
                       turned = in_contact_frames(SphereNetwork(p), g);
  const Matrix a = dense(g), b = dense(turned);
  EXPECT_LT((a.transpose() * a - b.transpose() * b).cwiseAbs().maxCoeff(), 1e-12);
  for (std::size_t r = 0; r < idx(turned.rows()); ++r) {
    const Link<3>& link = p.links[idx(turned.link_of_row[r])];
    if (turned.kind[r] != RowKind::normal || link.i == link.j) continue;
    const LinkFrame3<double> f = frame(ends(p, link));
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(b(static_cast<int>(r), 6 * link.j + k), f.n[idx(k)], 1e-14);
    for (int k = 3; k < 6; ++k) EXPECT_NEAR(b(static_cast<int>(r), 6 * link.j + k), 0, 1e-14);
  }
}

// Exactly, in a field: a rigid motion of an isolated packing is a null vector of every row.
TEST(SphereMatrix, RigidMotionsAreExactNullVectors) {
  using F = FirstField;
  const Packing<3> p = network(6, 8, false, {3, 3, 3}, 0.1);
  RigidBodiesOf<3> alone;
  alone.count = static_cast<std::int32_t>(p.bodies.size());
  alone.placement.resize(p.bodies.size());
  for (std::int32_t k = 0; k < alone.count; ++k) alone.body_of.push_back(k);
  for (const NetworkLaw law : kLaws) {
    const auto rows = body_rows<F>(SphereNetwork(p), law, false, alone, exact_geometry<F>(SphereNetwork(p)));
    EXPECT_EQ(static_cast<std::int64_t>(rows.size()), row_count(SphereNetwork(p), law));
    // Unknowns are V at the origin and W: the same for all bodies; of points V + W x x.
    const auto geometry = exact_geometry<F>(SphereNetwork(p));
    const Real3<F> v{F::random(1, 1), F::random(1, 2), F::random(1, 3)},
        w{F::random(1, 4), F::random(1, 5), F::random(1, 6)};
    for (std::size_t r = 0; r < rows.size(); ++r) {
      F sum{};
      for (const auto& block : rows.of(r)) {
        Real3<F> at = v;
        if (law == NetworkLaw::frictionless) at = sum_3d<F>(v, cross_3d<F>(w, geometry.position[idx(block.body)]));
        for (std::size_t d = 0; d < 3; ++d) sum = sum + block.at[d] * at[d] + block.at[3 + d] * w[d];
      }
      EXPECT_TRUE(sum.is_zero());
    }
  }
}

TEST(SphereMatrix, RankAndNullSpaceOfDenseSvd) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed)
    for (const NetworkLaw law : kLaws)
      for (const bool cell_free : {false, true}) {
        const Packing<3> p = network(seed, 3 + static_cast<double>(seed), true, {3, 2, 2}, 0.05);
        const SphereNetwork n(p);
        const Matrix a = dense(rigidity_matrix(n, law, cell_free));
        const Eigen::JacobiSVD<Matrix> svd(a);
        const Eigen::VectorXd s = svd.singularValues();
        const std::int64_t rank = (s.array() > 1e-9 * s(0)).count();
        const ExactRank exact = exact_rank(n, law, cell_free);
        EXPECT_EQ(exact.rank, rank);
        const auto dependent = dependent_columns(n, law, cell_free);
        EXPECT_EQ(std::count(dependent.begin(), dependent.end(), 1), exact.floppy);
        Matrix independent(a.rows(), rank);
        int at = 0;
        for (int c = 0; c < a.cols() && at < rank; ++c)
          if (!dependent[idx(c)]) independent.col(at++) = a.col(c);
        EXPECT_EQ(at, rank);
        EXPECT_EQ(Eigen::ColPivHouseholderQR<Matrix>(independent).rank(), rank);
      }
}

TEST(SphereBases, FloppyModesAndSelfStress) {
  for (const NetworkLaw law : kLaws) {
    const Packing<3> p = network(3, law == NetworkLaw::frictionless ? 7 : 5, true, {3, 3, 3}, 0.05);
    const SphereNetwork n(p);
    const ExactRank exact = exact_rank(n, law, true);
    const auto floppy = floppy_modes(n, law, true, 1000), stress = self_stress_states(n, law, true, 1000);
    EXPECT_EQ(static_cast<std::int64_t>(floppy.size()), exact.floppy);
    EXPECT_EQ(static_cast<std::int64_t>(stress.size()), exact.hyperstatic);
    for (const NullVector& v : floppy) EXPECT_LT(v.residual, 1e-9);
    for (const NullVector& v : stress) EXPECT_LT(v.residual, 1e-9);
    const auto rank_of = [](const std::vector<NullVector>& vectors) -> std::int64_t {
      if (vectors.empty()) return 0;
      Matrix m(static_cast<int>(vectors[0].value.size()), static_cast<int>(vectors.size()));
      for (int c = 0; c < m.cols(); ++c)
        m.col(c) = Eigen::Map<const Eigen::VectorXd>(vectors[idx(c)].value.data(), m.rows());
      return Eigen::ColPivHouseholderQR<Matrix>(m).rank();
    };
    EXPECT_EQ(rank_of(floppy), exact.floppy);
    EXPECT_EQ(rank_of(stress), exact.hyperstatic);
  }
}

TEST(SphereStiffnessMatrix, SingularValuesAndModesOfDense) {
  for (const NetworkLaw law : kLaws) {
    const Packing<3> p = network(8, 9, true, {3, 2, 2});
    const SphereNetwork n(p);
    const ExactRank exact = exact_rank(n, law, false);
    // Modes: K u = omega^2 M u.
    const auto k = by_link(p, UniformStiffness{2, 1.5, 0.25, -0.1});
    const Matrix stiffness = dense(stiffness_matrix(n, law, false, k));
    const int per_body = law == NetworkLaw::frictionless ? 3 : 6;
    Matrix scaled = stiffness;
    for (int r = 0; r < scaled.rows(); ++r)
      for (int c = 0; c < scaled.cols(); ++c) {
        const auto mass = [&](int d) {
          return d % per_body < 3 ? p.bodies.mass[idx(d / per_body)] : p.bodies.inertia[idx(d / per_body)];
        };
        scaled(r, c) /= std::sqrt(mass(r) * mass(c));
      }
    const Eigen::VectorXd lambda = Eigen::SelfAdjointEigenSolver<Matrix>(scaled).eigenvalues();
    const VibrationModes modes = vibration_modes(n, law, k, 5, false);
    EXPECT_EQ(modes.zero_modes, exact.floppy);
    for (std::size_t m = 0; m < 5; ++m)
      EXPECT_NEAR(modes.omega[m], std::sqrt(lambda(static_cast<int>(exact.floppy) + static_cast<int>(m))),
                  1e-6 * modes.omega[m]);
    const auto soft = smallest_singular_values(n, law, false, 3);
    EXPECT_EQ(soft.size(), 3u);
    EXPECT_GT(soft[0], 0);
  }
}

// Moduli by a dense pseudo-inverse; with friction an affine strain of a lattice is felt by every row.
TEST(SphereStiffnessMatrix, ModuliOfDense) {
  for (const NetworkLaw law : kLaws) {
    const Packing<3> p = network(12, 12, true, {3, 3, 2});
    const SphereNetwork n(p);
    const UniformStiffness uniform{3, 2, 0.5, -0.1};
    const auto k = by_link(p, uniform);
    const SphereModuli c = elastic_moduli(n, law, k);
    // With the diagonal strains as columns of G the first block is a Schur complement.
    const Matrix whole = dense(stiffness_matrix(n, law, true, k));
    const int inner = static_cast<int>(whole.rows()) - 3;
    const Matrix inverse = whole.topLeftCorner(inner, inner).completeOrthogonalDecomposition().pseudoInverse();
    const Matrix schur =
        whole.bottomRightCorner(3, 3) - whole.bottomLeftCorner(3, inner) * inverse * whole.topRightCorner(inner, 3);
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b)
        EXPECT_NEAR(c[idx(a)][idx(b)], schur(a, b) / p.cell->measure(), 1e-8 * std::abs(c[0][0]));
    for (std::size_t a = 0; a < 6; ++a) {
      EXPECT_GT(c[a][a], 0);
      for (std::size_t b = 0; b < 6; ++b) EXPECT_NEAR(c[a][b], c[b][a], 1e-9 * c[0][0]);
    }
  }
}

// Simple cubic lattice of springs: C_11 = K_N / d, C_44 = K_T / (4 d) ... of contacts that resist sliding alone.
TEST(SphereStiffnessMatrix, CubicLattice) {
  Packing<3> p;
  p.cell = PeriodicCell<3>{{{1, 1, 1}}};
  p.bodies.resize(1);
  p.bodies.radius = {0.5};
  for (std::size_t a = 0; a < 3; ++a) {
    Link<3> link;
    link.shift[a] = 1;
    p.links.push_back(link);
  }
  const SphereModuli c = elastic_moduli(SphereNetwork(p), NetworkLaw::friction, by_link(p, {5, 3, 1, -1}));
  for (std::size_t a = 0; a < 3; ++a) {
    EXPECT_NEAR(c[a][a], 5, 1e-12);
    // Two contacts shear by gamma/2 each way; the grain does not turn: it cannot choose between them.
    EXPECT_NEAR(c[3 + a][3 + a], 2 * 3 * 0.25, 1e-12);
  }
  EXPECT_NEAR(c[0][1], 0, 1e-12);
}

// The geometric term: K of central forces with it is the Hessian of their energy.
TEST(SphereStiffnessMatrix, GeometricTermIsTheHessian) {
  Packing<3> p = network(5, 5, false, {2, 2, 2});
  const double stiffness = 2;
  const auto energy = [&](const std::vector<double>& u) {
    double sum = 0;
    for (const Link<3>& link : p.links) {
      Vec3 r = ends(p, link).branch;
      for (int k = 0; k < 3; ++k) r[k] += u[idx(3 * link.j + k)] - u[idx(3 * link.i + k)];
      const double h = norm(r) - p.bodies.radius[idx(link.i)] - p.bodies.radius[idx(link.j)];
      sum += 0.5 * stiffness * h * h;
    }
    return sum;
  };
  std::vector<SphereStiffness> k;
  for (const Link<3>& link : p.links) k.push_back({stiffness, 0, 0, -stiffness * frame(ends(p, link)).gap});
  const Matrix tangent = dense(stiffness_matrix(SphereNetwork(p), NetworkLaw::frictionless, false, k, true));
  const double step = 1e-4;
  std::vector<double> u(3 * p.bodies.size(), 0.0);
  for (std::size_t a = 0; a < u.size(); ++a)
    for (std::size_t b = 0; b < u.size(); ++b) {
      double second = 0;
      for (const auto& [da, db] : {std::pair{1, 1}, {1, -1}, {-1, 1}, {-1, -1}}) {
        auto at = u;
        at[a] += da * step, at[b] += db * step;
        second += da * db * energy(at);
      }
      EXPECT_NEAR(tangent(static_cast<int>(a), static_cast<int>(b)), second / (4 * step * step), 1e-6);
    }
}

// Dense reference of clusters: grains move as one body if in every null vector of an SVD they do.
TEST(SphereClusters, MoveAsOneBody) {
  for (const NetworkLaw law : kLaws) {
    const Packing<3> p = network(21, law == NetworkLaw::frictionless ? 7 : 4.2, false, {3, 3, 2}, 0.05);
    const SphereNetwork n(p);
    const RigidClusters found = rigid_clusters(n, law, false);
    const Matrix a = dense(rigidity_matrix(n, law, false));
    const Eigen::JacobiSVD<Matrix> svd(a, Eigen::ComputeFullV);
    const auto floppy = static_cast<int>(exact_rank(n, law, false).floppy);
    const Matrix null = svd.matrixV().rightCols(floppy);
    std::int64_t sum_h = 0;
    for (std::size_t c = 0; c < found.clusters.size(); ++c) {
      std::set<std::int32_t> members;
      for (const std::int32_t l : found.links[c]) members.insert({p.links[idx(l)].i, p.links[idx(l)].j});
      EXPECT_EQ(static_cast<std::int64_t>(members.size()), found.clusters[c].grains);
      sum_h += found.clusters[c].hyperstatic;
      for (const std::int32_t i : members)
        for (const std::int32_t j : members) {
          const Vec3 r = p.bodies.position[idx(j)] - p.bodies.position[idx(i)];
          for (int m = 0; m < floppy; ++m) {
            const int per_body = law == NetworkLaw::frictionless ? 3 : 6;
            Vec3 dv;
            for (int k = 0; k < 3; ++k) dv[k] = null(per_body * j + k, m) - null(per_body * i + k, m);
            EXPECT_NEAR(dot(dv, r), 0, 1e-9);
            for (int k = 3; k < per_body; ++k) EXPECT_NEAR(null(6 * i + k, m), null(6 * j + k, m), 1e-9);
          }
        }
    }
    EXPECT_LE(sum_h, exact_rank(n, law, false).hyperstatic);
    if (law == NetworkLaw::friction) {  // what joins two clusters, or none, is no part of one
      for (std::size_t l = 0; l < p.links.size(); ++l) {
        if (found.cluster_of_link[l] >= 0) continue;
        const auto i = 6 * p.links[l].i, j = 6 * p.links[l].j;
        EXPECT_GT((null.middleRows(i + 3, 3) - null.middleRows(j + 3, 3)).cwiseAbs().maxCoeff(), 1e-9);
      }
    }
  }
}

}  // namespace
}  // namespace isostat
