// One definition of a link: with G the linear map from body velocities to link velocities, the solver's link velocities
// are G U and its body forces G^T f, for every kernel (law x instruction set x what it sums up). G is the matrix of
// analysis/rigidity, itself held against a dense one written here straight from Gilabert 2007, Eqs. A1-A6, columns
// (v_x, v_y, omega) of each body.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <cmath>
#include <string>
#include <vector>

#include "analysis/rigidity/rigidity_matrix.hpp"
#include "dem/disks/engine.hpp"
#include "dem/state/link.hpp"
#include "tests/support/disk_states.hpp"
#include "tests/support/machine_isas.hpp"

namespace isostat {
namespace {

Eigen::VectorXd velocities(const Bodies<2>& b) {
  Eigen::VectorXd u(3 * static_cast<Eigen::Index>(b.size()));
  for (std::size_t k = 0; k < b.size(); ++k)
    u.segment<3>(3 * static_cast<Eigen::Index>(k)) << b.velocity[k][0], b.velocity[k][1], b.spin[k];
  return u;
}

Eigen::MatrixXd from_the_paper(const Packing<2>& p) {
  Eigen::MatrixXd g = Eigen::MatrixXd::Zero(3 * static_cast<Eigen::Index>(p.links.size()),
                                            3 * static_cast<Eigen::Index>(p.bodies.size()));
  for (std::size_t l = 0; l < p.links.size(); ++l) {
    const Link<2>& link = p.links[l];
    const auto i = static_cast<std::size_t>(link.i), j = static_cast<std::size_t>(link.j);
    const Vec2 r = p.bodies.position[j] + p.cell->offset(link.shift) - p.bodies.position[i];
    const double d = std::hypot(r[0], r[1]), sum = p.bodies.radius[i] + p.bodies.radius[j];
    const Eigen::Vector2d n(r[0] / d, r[1] / d), t(-n[1], n[0]);
    const auto row = 3 * static_cast<Eigen::Index>(l), ci = 3 * static_cast<Eigen::Index>(i),
               cj = 3 * static_cast<Eigen::Index>(j);
    g.block<1, 2>(row, cj) += n.transpose(), g.block<1, 2>(row, ci) -= n.transpose();
    g.block<1, 2>(row + 1, cj) += t.transpose(), g.block<1, 2>(row + 1, ci) -= t.transpose();
    g(row + 1, ci + 2) -= d * p.bodies.radius[i] / sum, g(row + 1, cj + 2) -= d * p.bodies.radius[j] / sum;
    g(row + 2, cj + 2) += 1, g(row + 2, ci + 2) -= 1;
  }
  return g;
}

// The analysis' G, spread to three rows a link (those it does not keep stay zero).
Eigen::MatrixXd assemble(const Packing<2>& p) {
  const RigidityMatrix m = rigidity_matrix(p, NetworkLaw::rolling, false);
  Eigen::MatrixXd g = Eigen::MatrixXd::Zero(3 * static_cast<Eigen::Index>(p.links.size()),
                                            3 * static_cast<Eigen::Index>(p.bodies.size()));
  for (std::int64_t r = 0; r < m.rows(); ++r)
    for (std::int64_t k = m.row_start[static_cast<std::size_t>(r)]; k < m.row_start[static_cast<std::size_t>(r) + 1];
         ++k) {
      const auto at = static_cast<std::size_t>(r);
      g(3 * m.link_of_row[at] + static_cast<int>(m.kind[at]), m.column[static_cast<std::size_t>(k)]) +=
          m.value[static_cast<std::size_t>(k)];
    }
  return g;
}

// A kernel of the solver: the law's axes that it has, the instruction set, and what it sums up beside the forces
// (a fixed cell nothing, a barostat the stress, the ledger the energy).
struct Kernel {
  bool adhesion, friction, rolling;
  double damping;
  Isa isa;
  Tally tally;
};

std::string words(const Kernel& k) {
  return std::string(k.adhesion ? "adhesion, " : "") + (k.friction ? "friction, " : "") +
         (k.rolling ? "rolling, " : "") + (k.damping > 0 ? "damping, " : "") + std::string(name(k.isa)) + ", tally " +
         std::to_string(static_cast<int>(k.tally));
}

std::vector<Kernel> kernels() {
  std::vector<Kernel> list;
  for (const Isa isa : machine_isas())
    for (const Tally tally : {Tally::nothing, Tally::stress, Tally::energy})
      for (const bool adhesion : {false, true})
        for (const double damping : {0.0, 0.5})
          for (int turning = 0; turning < 3; ++turning)
            list.push_back({adhesion, turning > 0, turning > 1, damping, isa, tally});
  return list;
}

// The wall of the cell does not move: all that differs between the tallies is the kernel.
CellControl<2> control_of(const Kernel& k, const State<Disks>& s) {
  CellControl<2> c;
  if (k.tally == Tally::stress)
    c.stress = isotropic<2>(0.1), c.max_strain_rate = 1e-12, c.inertia = oracle::total_mass(s);
  return c;
}
SolverOptions options_of(const Kernel& k) { return {1, k.isa, k.tally == Tally::energy}; }

// Loaded by a march, so that springs are stretched; nothing slips.
State<Disks> loaded_packing(const Kernel& k) {
  oracle::RandomDisks r;
  r.law = oracle::soft_law(), r.squeeze = 0.9, r.law.friction = 50, r.law.rolling_friction = 50;
  if (!k.adhesion) r.law.attraction = 0;
  if (!k.friction) r.law.friction = 0;
  if (!k.rolling) r.law.rolling = false;
  r.law.damping = k.damping;
  State<Disks> s = random_state(r);
  Solver solver(s, control_of(k, s), options_of(k));
  solver.run(80);
  solver.snapshot(s);
  return s;
}

TEST(VirtualWork, TheAnalysisAssemblesTheMatrixOfThePaper) {
  const Packing<2> p = loaded_packing({true, true, true, 0.5, Isa::scalar, Tally::nothing}).packing;
  const Eigen::MatrixXd g = assemble(p), paper = from_the_paper(p);
  for (std::size_t l = 0; l < p.links.size(); ++l) {
    ASSERT_TRUE(p.links[l].kind == LinkKind::closed || p.links[l].kind == LinkKind::distant);
    const Eigen::Index kept = p.links[l].kind == LinkKind::closed ? 3 : 1;
    const auto row = 3 * static_cast<Eigen::Index>(l);
    EXPECT_LT((g.middleRows(row, kept) - paper.middleRows(row, kept)).cwiseAbs().maxCoeff(), 1e-14);
  }
}

TEST(VirtualWork, LinkVelocitiesOfTheSolverAreGTimesU) {
  for (const Kernel& k : kernels()) {
    if (!k.friction) continue;  // no spring shows what it saw
    SCOPED_TRACE(words(k));
    State<Disks> s = loaded_packing(k);
    ASSERT_GT(s.packing.links.size(), 10u);
    // A step so short that no link changes: the springs stretch by dt G U, U those of the half step.
    s.memory = {};
    s.time_step = 1e-8;
    for (Link<2>& l : s.packing.links) l.tangential_force = l.moment = 0;
    Solver solver(s, control_of(k, s), options_of(k));
    solver.step();
    solver.snapshot(s);
    Packing<2> moving = s.packing;
    moving.bodies.velocity = s.memory.half_velocity;
    moving.bodies.spin = s.memory.half_spin;
    const Eigen::VectorXd velocity = from_the_paper(s.packing) * velocities(moving.bodies);
    const double scale = velocity.cwiseAbs().maxCoeff();
    int stretched = 0, rolled = 0;
    for (std::size_t l = 0; l < s.packing.links.size(); ++l) {
      const Link<2>& link = s.packing.links[l];
      const auto row = 3 * static_cast<Eigen::Index>(l);
      const auto i = static_cast<std::size_t>(link.i), j = static_cast<std::size_t>(link.j);
      const Bodies<2>& b = moving.bodies;
      const Vec2 r = b.position[j] + s.packing.cell->offset(link.shift) - b.position[i],
                 v = b.velocity[j] - b.velocity[i];
      const LinkVelocity<double> shared =
          link_velocity(link_frame(r[0], r[1], b.radius[i], b.radius[j]), v[0], v[1], b.spin[i], b.spin[j]);
      EXPECT_NEAR(shared.normal, velocity[row], 1e-13 * scale);
      EXPECT_NEAR(shared.tangential, velocity[row + 1], 1e-13 * scale);
      EXPECT_NEAR(shared.rolling, velocity[row + 2], 1e-13 * scale);
      if (link.gap >= 0) continue;
      EXPECT_NEAR(link.tangential_force / (-s.law.tangential_stiffness * s.time_step), velocity[row + 1], 1e-7 * scale);
      ++stretched;
      if (!k.rolling) continue;
      EXPECT_NEAR(link.moment / (-s.law.rolling_stiffness * s.time_step), velocity[row + 2], 1e-7 * scale);
      ++rolled;
    }
    EXPECT_GT(stretched, 8);
    EXPECT_EQ(rolled > 8, k.rolling);
  }
}

TEST(VirtualWork, BodyForcesOfTheSolverAreGTransposedTimesTheLinkForces) {
  for (const Kernel& k : kernels()) {
    SCOPED_TRACE(words(k));
    State<Disks> s = loaded_packing(k);
    s.memory = {};
    Solver solver(s, control_of(k, s), options_of(k));  // evaluates the forces of the state as it stands
    solver.snapshot(s);
    const Eigen::MatrixXd g = from_the_paper(s.packing);
    const Eigen::VectorXd velocity = g * velocities(s.packing.bodies);
    Eigen::VectorXd f(g.rows());
    double largest_moment = 0;
    for (std::size_t l = 0; l < s.packing.links.size(); ++l) {
      const Link<2>& link = s.packing.links[l];
      const auto row = 3 * static_cast<Eigen::Index>(l);
      const double mi = s.packing.bodies.mass[static_cast<std::size_t>(link.i)],
                   mj = s.packing.bodies.mass[static_cast<std::size_t>(link.j)];
      const double eta = k.damping * 2 * std::sqrt(s.law.normal_stiffness * mi * mj / (mi + mj));
      f.segment<3>(row) << link.normal_force - (link.gap < 0 ? eta * velocity[row] : 0), link.tangential_force,
          link.moment;
      largest_moment = std::max(largest_moment, std::abs(link.moment));
    }
    EXPECT_EQ(largest_moment > 0.01, k.rolling);
    const Eigen::VectorXd force = g.transpose() * f;
    const double scale = f.cwiseAbs().maxCoeff();
    for (std::size_t b = 0; b < s.packing.bodies.size(); ++b) {
      const auto row = 3 * static_cast<Eigen::Index>(b);
      EXPECT_NEAR(s.memory.force[b][0], force[row], 1e-12 * scale);
      EXPECT_NEAR(s.memory.force[b][1], force[row + 1], 1e-12 * scale);
      if (k.friction) {
        EXPECT_NEAR(s.memory.torque[b], force[row + 2], 1e-12 * scale);
      }
    }
  }
}

}  // namespace
}  // namespace isostat
