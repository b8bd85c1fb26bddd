// One definition of a link: what the solver's kernels do in a step is G and G^T of the analysis, to rounding.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "analysis/rigidity/rigidity_matrix.hpp"
#include "dem/disks/engine.hpp"
#include "dem/disks/sample.hpp"

namespace isostat {
namespace {

// A jittered triangular lattice of overlapping disks with random velocities, springs at rest, no damping, no sliding.
State<Disks> lattice_state(std::uint64_t seed, bool rolling) {
  State<Disks> s;
  s.law.normal_stiffness = 1e4;
  s.law.tangential_stiffness = 7e3;
  s.law.friction = 1e6;
  if (rolling) s.law.rolling_friction = 1e6, s.law.rolling_stiffness = 11;
  s.packing.cell = PeriodicCell<2>{{8, 8 * std::sqrt(3.0) / 2}};
  std::mt19937_64 random(seed);
  const auto draw = [&] { return std::uniform_real_distribution<>(-1.0, 1.0)(random); };
  Bodies<2>& b = s.packing.bodies;
  b.resize(64);
  for (std::size_t i = 0; i < 64; ++i) {
    const auto x = static_cast<double>(i % 8), y = static_cast<double>(i / 8);
    b.id[i] = static_cast<std::int64_t>(i);
    b.position[i] = {{x + 0.5 * std::fmod(y, 2) + 0.01 * draw(), y * std::sqrt(3.0) / 2 + 0.01 * draw()}};
    b.velocity[i] = {{draw(), draw()}};
    b.spin[i] = draw();
    b.radius[i] = 0.52 + 0.02 * draw();
  }
  set_disk_inertia(b);
  s.cell_motion.reference_length = s.packing.cell->length;
  s.scene.law.normal_stiffness = s.law.normal_stiffness;
  s.time_step = 1e-6 * std::sqrt(1 / s.law.normal_stiffness);
  return s;
}

TEST(SolverAndAnalysis, SpringsStretchByGTimesVelocities) {
  for (const bool rolling : {false, true})
    for (const Isa isa : {Isa::scalar, best_isa()}) {
      State<Disks> s = lattice_state(3, rolling);
      Solver solver(s, CellControl{}, {1, isa, false});
      solver.step();
      solver.snapshot(s);
      ASSERT_GT(s.packing.links.size(), 180u);

      Packing<2> moving = s.packing;  // the springs were stretched by the half-step velocities
      moving.bodies.velocity = s.memory.half_velocity;
      moving.bodies.spin = s.memory.half_spin;
      const NetworkLaw law = rolling ? NetworkLaw::rolling : NetworkLaw::friction;
      const RigidityMatrix g = rigidity_matrix(s.packing, law, false);
      const auto velocity = g.link_velocities(body_velocities(moving, g.layout, {}));
      int tangential = 0, moments = 0;
      for (std::size_t r = 0; r < velocity.size(); ++r) {
        const Link<2>& link = s.packing.links[static_cast<std::size_t>(g.link_of_row[r])];
        if (g.component[r] == 1) {
          EXPECT_NEAR(link.tangential_force, -s.law.tangential_stiffness * s.time_step * velocity[r],
                      1e-14 * s.law.tangential_stiffness * s.time_step * 10);
          ++tangential;
        } else if (g.component[r] == 2) {
          EXPECT_NEAR(link.moment, -s.law.rolling_stiffness * s.time_step * velocity[r],
                      1e-14 * s.law.rolling_stiffness * s.time_step * 10);
          ++moments;
        }
      }
      EXPECT_GT(tangential, 180);
      EXPECT_EQ(moments > 0, rolling);
    }
}

TEST(SolverAndAnalysis, BodyForcesAreTheTransposeTimesLinkForces) {
  for (const bool rolling : {false, true})
    for (const Isa isa : {Isa::scalar, best_isa()}) {
      State<Disks> s = lattice_state(4, rolling);
      Solver solver(s, CellControl{}, {1, isa, false});
      solver.run(200);
      solver.snapshot(s);
      const NetworkLaw law = rolling ? NetworkLaw::rolling : NetworkLaw::friction;
      const RigidityMatrix g = rigidity_matrix(s.packing, law, false);
      const auto forces = link_forces(s.packing, g);
      const auto expected = g.body_forces(forces);
      double scale = 0;
      for (double f : forces) scale = std::max(scale, std::abs(f));
      for (std::size_t i = 0; i < s.packing.bodies.size(); ++i) {
        EXPECT_NEAR(s.memory.force[i][0], expected[3 * i], 1e-13 * scale);
        EXPECT_NEAR(s.memory.force[i][1], expected[3 * i + 1], 1e-13 * scale);
        EXPECT_NEAR(s.memory.torque[i], expected[3 * i + 2], 1e-13 * scale);
      }
    }
}

}  // namespace
}  // namespace isostat
