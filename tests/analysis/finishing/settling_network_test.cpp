// Forces and tangent of a settling packing against the certificate and finite differences; the linear algebra against
// dense solves.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "analysis/finishing/gmres.hpp"
#include "analysis/finishing/repeated_cholesky.hpp"
#include "analysis/finishing/settling_network.hpp"
#include "dem/disks/certificate.hpp"
#include "dem/disks/engine.hpp"
#include "dem/solver/random.hpp"
#include "dem/state/balance.hpp"
#include "tests/support/disk_states.hpp"

namespace isostat {
namespace {

using Vector = std::vector<double>;

// Overlapping disks with stretched springs, a few distant links.
State<Disks> stretched_state(double friction, std::uint64_t seed) {
  oracle::RandomDisks r;
  r.law = oracle::soft_law();
  r.law.friction = friction, r.law.rolling_friction = 0.1 * friction;
  r.seed = seed, r.speed = 0.5;
  State<Disks> s = oracle::random_state(r);
  Solver solver(s, CellControl<2>{}, {});
  solver.run(20);
  solver.snapshot(s);
  return s;
}
// The cell keeps its shape, or its edges are free, or its angle as well.
enum class CellIs { fixed, free, shearing };
FinishingRequest<2> request(CellIs cell) {
  FinishingRequest<2> q;
  if (cell != CellIs::fixed) q.stress = {3.0, 5.0};
  if (cell == CellIs::shearing) q.stress.shear = -2.0;
  q.cell_inertia = 7;
  return q;
}
// The same packing in a cell whose second edge ends two cells further on.
void tilt(State<Disks>& s) {
  s.packing.cell->tilt = 2 * s.packing.cell->length[0];
  for (Link<2>& l : s.packing.links) l.shift[0] -= 2 * l.shift[1];
}
Vector random_step(std::size_t size, double scale, std::uint64_t seed) {
  Random random(seed);
  Vector x(size);
  for (double& v : x) v = scale * random.normal();
  return x;
}
double length(const Vector& v) {
  double s = 0;
  for (double x : v) s += x * x;
  return std::sqrt(s);
}

TEST(SettlingNetwork, ForcesAreThoseOfTheCertificate) {
  const State<Disks> s = stretched_state(0.3, 4);
  SettlingNetwork network(s, request(CellIs::free));
  network.forces(Vector(network.size(), 0.0));
  const SettlingNetwork::Balance b = network.balance();
  State<Disks> still = s;
  for (Vec2& v : still.packing.bodies.velocity) v = {};
  const Certificate c = evaluate_certificate(still.packing, s.law, isotropic<2>(3.0), s.scene.equilibrium);
  ASSERT_GT(c.max_force, 1);
  EXPECT_NEAR(b.force / (c.max_force * c.force_scale), 1, 1e-12);
  EXPECT_NEAR(b.moment / (c.max_moment * c.force_scale), 1, 1e-12);
  const StressTensor stress = measured_stress(still.packing);
  EXPECT_NEAR(b.stress, std::max(std::abs(stress.xx - 3), std::abs(stress.yy - 5)), 1e-10 * std::abs(stress.yy));
}

// Of a tilted cell as well, whichever of the equivalent tilts describes it.
TEST(SettlingNetwork, KnowsShearStressAndTilt) {
  State<Disks> s = stretched_state(0.3, 4);
  SettlingNetwork upright(s, request(CellIs::shearing));
  const Vector forces = upright.forces(Vector(upright.size(), 0.0));
  State<Disks> still = s;
  for (Vec2& v : still.packing.bodies.velocity) v = {};
  const StressTensor stress = measured_stress(still.packing);
  const double area = upright.area();
  EXPECT_NEAR(forces.back(), (-2.0 - stress.xy) * area / std::sqrt(area), 1e-9 * std::abs(stress.yy) * std::sqrt(area));
  tilt(s);
  SettlingNetwork tilted(s, request(CellIs::shearing));
  const Vector same = tilted.forces(Vector(tilted.size(), 0.0));
  Vector step = random_step(tilted.size(), 2e-4, 3);
  const Vector there = tilted.forces(step), here = upright.forces(step);
  for (std::size_t k = 0; k < forces.size(); ++k) {
    EXPECT_NEAR(same[k], forces[k], 1e-10 * length(forces));
    EXPECT_NEAR(there[k], here[k], 1e-10 * length(here));
  }
  tilted.accept(step), upright.accept(step);
  const Vector after = tilted.forces(), before = upright.forces();
  for (std::size_t k = 0; k < after.size(); ++k) EXPECT_NEAR(after[k], before[k], 1e-10 * length(before));
}

// Central differences about a finite trial step, with contacts that slide and yield and a cell that shrinks.
TEST(SettlingNetwork, TheTangentIsTheDerivativeOfTheForces) {
  for (const double friction : {0.02, 0.3, 5.0})
    for (const CellIs cell : {CellIs::fixed, CellIs::free, CellIs::shearing}) {
      State<Disks> s = stretched_state(friction, 5);
      if (cell == CellIs::shearing) tilt(s);
      SettlingNetwork network(s, request(cell));
      const Vector base = random_step(network.size(), 2e-4, 6), direction = random_step(network.size(), 1, 7);
      network.forces(base);
      const SettlingNetwork::Balance status = network.balance();
      if (friction < 0.1) {
        ASSERT_GT(status.sliding, 3);
        ASSERT_GT(status.yielded, 3);
      }
      if (friction > 1) {
        ASSERT_EQ(status.sliding, 0);
      }
      const Vector exact = network.stiffness_times(direction);
      const double h = 1e-8;  // [a] small beside the distance of any contact from a change of status
      Vector plus = base, minus = base;
      for (std::size_t k = 0; k < base.size(); ++k) plus[k] += h * direction[k], minus[k] -= h * direction[k];
      const Vector up = network.forces(plus), down = network.forces(minus);
      Vector error(base.size());
      for (std::size_t k = 0; k < base.size(); ++k) error[k] = exact[k] + (up[k] - down[k]) / (2 * h);
      EXPECT_LT(length(error), 1e-6 * length(exact)) << "friction " << friction << " cell " << static_cast<int>(cell);
    }
}

// Without yielding, in a fixed cell, the assembled matrix is the symmetric part: (x.Ky + y.Kx)/2 = x.Sy.
TEST(SettlingNetwork, TheAssembledMatrixIsTheSymmetricPart) {
  SettlingNetwork network(stretched_state(5.0, 8), request(CellIs::fixed));
  network.forces(random_step(network.size(), 2e-4, 9));
  ASSERT_EQ(network.balance().sliding, 0);
  const double shift = 11;
  const SymmetricMatrix& matrix = network.shifted_stiffness(shift);
  for (std::uint64_t seed = 20; seed < 25; ++seed) {
    const Vector x = random_step(network.size(), 1, seed), y = random_step(network.size(), 1, seed + 100);
    const Vector kx = network.stiffness_times(x), ky = network.stiffness_times(y), sy = matrix.multiply(y);
    double want = 0, have = 0;
    for (std::size_t k = 0; k < x.size(); ++k) {
      want += 0.5 * (x[k] * ky[k] + y[k] * kx[k]) + shift * network.inertia()[k] * x[k] * y[k];
      have += x[k] * sy[k];
    }
    EXPECT_NEAR(have, want, 1e-11 * length(x) * length(sy));
  }
}

// With the cell free, what is left out of the strains' rows is of the order of the stress, not of the stiffness.
TEST(SettlingNetwork, TheAssembledMatrixKnowsTheCell) {
  SettlingNetwork network(stretched_state(5.0, 8), request(CellIs::shearing));
  network.forces(Vector(network.size(), 0.0));
  const SymmetricMatrix& matrix = network.shifted_stiffness(0);
  Vector strain(network.size(), 0.0);
  strain[network.size() - 3] = 1, strain[network.size() - 2] = -0.5, strain[network.size() - 1] = 0.7;
  const Vector exact = network.stiffness_times(strain), assembled = matrix.multiply(strain);
  Vector error = exact;
  for (std::size_t k = 0; k < error.size(); ++k) error[k] -= assembled[k];
  EXPECT_LT(length(error), 0.05 * length(exact));
}

TEST(Gmres, SolvesANonsymmetricSystem) {
  const Eigen::Index n = 40;
  Random random(3);
  Eigen::MatrixXd a(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) a(i, j) = (i == j ? 10.0 + static_cast<double>(i) : 0.0) + random.normal();
  const Vector b = random_step(static_cast<std::size_t>(n), 1, 4);
  const auto apply = [&](const Vector& x) {
    const Eigen::VectorXd y = a * Eigen::Map<const Eigen::VectorXd>(x.data(), n);
    return Vector(y.data(), y.data() + n);
  };
  const auto precondition = [&](const Vector& x) {
    Vector y = x;
    for (Eigen::Index i = 0; i < n; ++i) y[static_cast<std::size_t>(i)] /= a(i, i);
    return y;
  };
  const LinearSolution s = gmres(apply, precondition, b, 1e-12, 40);
  const Eigen::VectorXd want = a.partialPivLu().solve(Eigen::Map<const Eigen::VectorXd>(b.data(), n));
  for (Eigen::Index i = 0; i < n; ++i) EXPECT_NEAR(s.x[static_cast<std::size_t>(i)], want(i), 1e-11 * want.norm());
  EXPECT_LT(s.residual, 1e-12);
  // Cut short, it says so.
  const LinearSolution cut = gmres(apply, precondition, b, 1e-12, 3);
  EXPECT_EQ(cut.iterations, 3);
  EXPECT_GT(cut.residual, 1e-6);
  Vector r = apply(cut.x);
  for (std::size_t k = 0; k < r.size(); ++k) r[k] -= b[k];
  EXPECT_NEAR(length(r) / length(b), cut.residual, 1e-10);
}

TEST(RepeatedCholesky, FollowsTheValuesAndRefusesWhatIsNotPositive) {
  SymmetricMatrix a;  // tridiagonal 2, -1
  a.size = 50;
  a.start = {0};
  for (std::int32_t c = 0; c < a.size; ++c) {
    a.row.push_back(c), a.value.push_back(2);
    if (c + 1 < a.size) a.row.push_back(c + 1), a.value.push_back(-1);
    a.start.push_back(static_cast<std::int32_t>(a.row.size()));
  }
  const Vector b = random_step(50, 1, 5);
  RepeatedCholesky factor;
  for (const double scale : {1.0, 3.0}) {
    SymmetricMatrix scaled = a;
    for (double& v : scaled.value) v *= scale;
    ASSERT_TRUE(factor.factorise(scaled, 1));
    const Vector back = scaled.multiply(factor.solve(b));
    for (std::size_t k = 0; k < b.size(); ++k) EXPECT_NEAR(back[k], b[k], 1e-11);
  }
  SymmetricMatrix indefinite = a;
  indefinite.value[20] = -0.1;
  EXPECT_FALSE(factor.factorise(indefinite, 1));
  EXPECT_TRUE(factor.factorise(a, 1));
  EXPECT_EQ(factor.factorisations(), 4);
}

}  // namespace
}  // namespace isostat
