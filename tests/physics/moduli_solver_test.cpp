// Elastic moduli against the solver: a real packing, strained a little both ways along each axis and relaxed.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <stdexcept>

#include "analysis/rigidity/exact_rank.hpp"
#include "analysis/stiffness/moduli.hpp"
#include "dem/disks/at_rest.hpp"
#include "dem/disks/engine.hpp"
#include "dem/disks/sample.hpp"
#include "dem/run/stages.hpp"
#include "dem/state/balance.hpp"
#include "dem/state/link.hpp"

namespace isostat {
namespace {

// (1/A) sum F_a r_a over the links (compression positive).
Vec2 static_stress(const Packing<2>& p) {
  Vec2 sigma;
  for (const Link<2>& l : p.links) {
    const auto i = static_cast<std::size_t>(l.i), j = static_cast<std::size_t>(l.j);
    const Vec2 r = p.bodies.position[j] + p.cell->offset(l.shift) - p.bodies.position[i];
    const auto f = link_frame(r[0], r[1], p.bodies.radius[i], p.bodies.radius[j]);
    sigma[0] += (l.normal_force * f.nx - l.tangential_force * f.ny) * r[0] / p.cell->measure();
    sigma[1] += (l.normal_force * f.ny + l.tangential_force * f.nx) * r[1] / p.cell->measure();
  }
  return sigma;
}

// Relaxes in a fixed cell under a drag, from the positions and springs of the state.
State<Disks> relaxed(State<Disks> s, int steps) {
  s.memory = {};
  for (auto& v : s.packing.bodies.velocity) v = {};
  for (auto& w : s.packing.bodies.spin) w = 0;
  s.cell_motion = {};
  s.cell_motion.reference_length = s.packing.cell->length;
  Solver solver(s, CellControl<2>{}, {});
  solver.set_drag(3.0);
  solver.run(steps);
  solver.snapshot(s);
  return s;
}

// Affine compression along an axis; springs are stretched by the affine relative displacement, as in a step.
State<Disks> strained(State<Disks> s, int axis, double strain) {
  for (Link<2>& l : s.packing.links) {
    const auto i = static_cast<std::size_t>(l.i), j = static_cast<std::size_t>(l.j);
    const Vec2 r = s.packing.bodies.position[j] + s.packing.cell->offset(l.shift) - s.packing.bodies.position[i];
    const auto f = link_frame(r[0], r[1], s.packing.bodies.radius[i], s.packing.bodies.radius[j]);
    Vec2 d;
    d[axis] = -strain * r[axis];
    if (l.kind != LinkKind::distant)
      l.tangential_force -= s.law.tangential_stiffness * link_velocity(f, d[0], d[1], 0.0, 0.0).tangential;
  }
  s.packing.cell->length[axis] *= 1 - strain;
  for (Vec2& r : s.packing.bodies.position) r[axis] *= 1 - strain;
  return s;
}

// A soft packing under pressure, relaxed to rounding.
State<Disks> real_packing() {
  Scene scene;
  scene.grains.count = 80;
  scene.law.normal_stiffness = 1e3;  // soft: the geometric term is then far above the rounding
  scene.law.attraction_range = 1e-2;
  scene.finish.method = Finish::drag;
  scene.finish.drag = 2;
  StageScene stage;
  stage.pressure = 1.0;
  scene.stages = {stage};
  State<Disks> s = initial_disks(scene, 3);
  if (!run_stages(s, {}, {}).all_met()) throw std::runtime_error("no equilibrium");
  return relaxed(s, 200000);
}

// Oracle for any strain: force balance of the displaced network with the forces evaluated anew from the displaced
// geometry, by Newton's method with a finite-difference Jacobian.
class DisplacedNetwork {
 public:
  explicit DisplacedNetwork(const State<Disks>& s) : s_(s) {}

  // Affine part -e r, e = (e11, e22, gamma12); u: displacement and rotation by body. Body forces, and the stress.
  Eigen::VectorXd forces(const Eigen::VectorXd& u, const std::array<double, 3>& e,
                         std::array<double, 3>& stress) const {
    const Packing<2>& p = s_.packing;
    Eigen::VectorXd f = Eigen::VectorXd::Zero(u.size());
    stress = {};
    const double area = p.cell->measure() * ((1 - e[0]) * (1 - e[1]) - e[2] * e[2] / 4);
    for (const Link<2>& l : p.links) {
      const auto i = static_cast<std::size_t>(l.i), j = static_cast<std::size_t>(l.j);
      const Eigen::Index a = 3 * l.i, b = 3 * l.j;
      const Vec2 r = p.bodies.position[j] + p.cell->offset(l.shift) - p.bodies.position[i];
      const double dx = u[b] - u[a] - e[0] * r[0] - e[2] / 2 * r[1],
                   dy = u[b + 1] - u[a + 1] - e[1] * r[1] - e[2] / 2 * r[0];
      const auto before = link_frame(r[0], r[1], p.bodies.radius[i], p.bodies.radius[j]);
      const auto now = link_frame(r[0] + dx, r[1] + dy, p.bodies.radius[i], p.bodies.radius[j]);
      const auto v = link_velocity(before, dx, dy, u[a + 2], u[b + 2]);  // the increment of the springs, to first order
      const bool distant = l.kind == LinkKind::distant;
      const double n = at_rest(s_.law, now.gap).force;
      const double t = distant ? 0 : l.tangential_force - s_.law.tangential_stiffness * v.tangential;
      const double m = distant ? 0 : l.moment - s_.law.rolling_stiffness * v.rolling;
      const auto load = link_load(now, n, t, m);
      f[b] += load.fx, f[b + 1] += load.fy, f[b + 2] += load.moment_j;
      f[a] -= load.fx, f[a + 1] -= load.fy, f[a + 2] += load.moment_i;
      stress[0] += load.fx * (r[0] + dx) / area;
      stress[1] += load.fy * (r[1] + dy) / area;
      stress[2] += (load.fx * (r[1] + dy) + load.fy * (r[0] + dx)) / 2 / area;
    }
    return f;
  }

  std::array<double, 3> relaxed_stress(const std::array<double, 3>& e) {
    const auto n = static_cast<Eigen::Index>(3 * s_.packing.bodies.size());
    Eigen::VectorXd u = Eigen::VectorXd::Zero(n);
    std::array<double, 3> stress{};
    if (solver_.cols() == 0) {
      constexpr double kStep = 1e-6;
      Eigen::MatrixXd jacobian(n, n);
      for (Eigen::Index c = 0; c < n; ++c) {
        u[c] = kStep;
        const Eigen::VectorXd up = forces(u, {}, stress);
        u[c] = -kStep;
        jacobian.col(c) = (up - forces(u, {}, stress)) / (2 * kStep);
        u[c] = 0;
      }
      for (Eigen::Index d = 0; d < 2; ++d) jacobian(d, d) -= 1e3;  // holds the first grain against translation
      solver_.compute(jacobian);
    }
    for (int iteration = 0; iteration < 30; ++iteration) u -= solver_.solve(forces(u, e, stress));
    residual = forces(u, e, stress).cwiseAbs().maxCoeff();
    return stress;
  }
  double residual = 0;

 private:
  const State<Disks>& s_;
  Eigen::PartialPivLU<Eigen::MatrixXd> solver_;
};

TEST(ModuliOfARealPacking, AgreeWithNonlinearForceBalance) {
  const State<Disks> s = real_packing();
  const TangentModuli tangent = tangent_moduli(s.packing, NetworkLaw::rolling, s.law);
  DisplacedNetwork network(s);
  constexpr double kStrain = 1e-6;
  for (std::size_t b = 0; b < 3; ++b) {
    std::array<double, 3> e{};
    e[b] = kStrain;
    const auto up = network.relaxed_stress(e);
    EXPECT_LT(network.residual, 1e-10);
    e[b] = -kStrain;
    const auto down = network.relaxed_stress(e);
    EXPECT_LT(network.residual, 1e-10);
    for (std::size_t a = 0; a < 3; ++a)
      EXPECT_NEAR(tangent.tensor[a][b], (up[a] - down[a]) / (2 * kStrain), 1e-6 * std::abs(tangent.tensor[0][0]))
          << a << b;
  }
}

TEST(ModuliOfARealPacking, AgreeWithTheSolver) {
  const State<Disks> s = real_packing();
  ASSERT_EQ(exact_rank(s.packing, NetworkLaw::rolling, false).mechanisms, 0);
  double residual = 0;
  for (const Vec2& f : s.memory.force) residual = std::max({residual, std::abs(f[0]), std::abs(f[1])});
  ASSERT_LT(residual, 1e-11);
  for (const Link<2>& l : s.packing.links) ASSERT_TRUE(l.kind == LinkKind::closed || l.kind == LinkKind::distant);

  const TangentModuli tangent = tangent_moduli(s.packing, NetworkLaw::rolling, s.law);
  const Moduli without = elastic_moduli(s.packing, NetworkLaw::rolling, s.law);
  constexpr double kStrain = 1e-7;
  double geometric_error = 0;
  for (int axis = 0; axis < 2; ++axis) {
    const State<Disks> plus = relaxed(strained(s, axis, kStrain), 200000),
                       minus = relaxed(strained(s, axis, -kStrain), 200000);
    ASSERT_EQ(plus.packing.links.size(), s.packing.links.size());
    ASSERT_EQ(minus.packing.links.size(), s.packing.links.size());
    const Vec2 up = static_stress(plus.packing), down = static_stress(minus.packing);
    for (int a = 0; a < 2; ++a) {
      const auto ua = static_cast<std::size_t>(a), ub = static_cast<std::size_t>(axis);
      const double measured = (up[a] - down[a]) / (2 * kStrain);
      EXPECT_NEAR(tangent.tensor[ua][ub], measured, 1e-6 * std::abs(tangent.tensor[0][0])) << a << axis;
      geometric_error =
          std::max(geometric_error, std::abs(without[ua][ub] - measured) / std::abs(tangent.tensor[0][0]));
    }
  }
  RecordProperty("relative_error_without_geometric_term", std::to_string(geometric_error));
  std::printf("relative error without the geometric term: %.3g, antisymmetric part %.3g\n", geometric_error,
              tangent.antisymmetric_part);
  EXPECT_GT(geometric_error, 1e-5);  // the test would not see the geometric term otherwise
}

// The step loop itself strains the cell, by a rate along each of its three components, and the packing relaxes. Simple
// shear is pure shear and a turn, which takes the stress along.
TEST(ModuliOfARealPacking, AreThoseOfTheCellThatTheSolverMoves) {
  const State<Disks> s = real_packing();
  const Moduli moduli = elastic_moduli(s.packing, NetworkLaw::rolling, s.law);
  const TangentModuli tangent = tangent_moduli(s.packing, NetworkLaw::rolling, s.law);
  constexpr double kStrain = 1e-7;
  constexpr int kSteps = 20;
  const auto moved = [&](std::size_t component, double strain) {
    State<Disks> to = s;
    to.memory = {};
    to.cell_motion = {};
    to.cell_motion.reference_length = to.packing.cell->length;
    CellControl<2> control;
    const double rate = strain / (kSteps * to.time_step);
    if (component < 2)
      control.strain_rate[static_cast<int>(component)] = rate;
    else
      control.shear_rate = -rate;  // compressive sense
    Solver solver(to, control);
    solver.set_drag(3.0);
    solver.run(kSteps);
    solver.snapshot(to);
    const State<Disks> still = relaxed(to, 200000);
    EXPECT_EQ(still.packing.links.size(), s.packing.links.size());
    const StressTensor stress = measured_stress(still.packing);
    return std::array<double, 3>{stress.xx, stress.yy, 0.5 * (stress.xy + stress.yx)};
  };
  const StressTensor at_rest = measured_stress(s.packing);
  for (std::size_t b = 0; b < 3; ++b) {
    const auto up = moved(b, kStrain), down = moved(b, -kStrain);
    // By -d(tilt)/L2 = e the axes turn by e/2, anticlockwise.
    const std::array<double, 3> turn =
        b < 2 ? std::array<double, 3>{}
              : std::array<double, 3>{-at_rest.xy, at_rest.xy, 0.5 * (at_rest.xx - at_rest.yy)};
    for (std::size_t a = 0; a < 3; ++a) {
      const double measured = (up[a] - down[a]) / (2 * kStrain) - turn[a];
      EXPECT_NEAR(tangent.tensor[a][b], measured, 1e-5 * std::abs(moduli[0][0])) << a << b;
      EXPECT_NEAR(moduli[a][b], measured, 1e-3 * std::abs(moduli[0][0])) << a << b;
    }
  }
}

}  // namespace
}  // namespace isostat
