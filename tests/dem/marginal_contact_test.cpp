// Contacts that stay at the edge of their range, h ~ 0. There the law is homogeneous (forces and the weights of
// dem/disks/kernel/crossing.hpp depend on h and dh/dt to first and zeroth order), so an amplitude can only grow or
// decay for ever; that it decays to rounding shows that forming and ending contacts feed no jitter.
#include <gtest/gtest.h>

#include <limits>

#include "dem/disks/engine.hpp"
#include "dem/disks/sample.hpp"
#include "dem/disks/scales.hpp"

namespace isostat {
namespace {

// Three disks of diameter a in a periodic row of length 3 a: every contact has h = 0 at rest, and what one opens the
// others are pressed by.
State<Disks> marginal_row(const LawScene& law) {
  State<Disks> s;
  s.scene.law = law;
  s.law = resolve(law);
  Bodies<2>& b = s.packing.bodies;
  b.resize(3);
  const double speed[] = {1e-3, -0.4e-3, -0.6e-3};  // [a/T0] no drift
  for (std::size_t k = 0; k < 3; ++k) {
    b.id[k] = static_cast<std::int64_t>(k);
    b.position[k] = {{0.5 + static_cast<double>(k), 1.5}};
    b.velocity[k] = {{speed[k], 0}};
    b.radius[k] = 0.5;
  }
  set_disk_inertia(b);
  s.packing.cell = PeriodicCell<2>{{{3, 3}}};
  s.cell_motion.reference_length = s.packing.cell->length;
  s.time_step = time_step(s.scene, s.law.normal_stiffness, s.packing);
  return s;
}

double kinetic_energy(const Bodies<2>& b) {
  double sum = 0;
  for (std::size_t k = 0; k < b.size(); ++k)
    sum += 0.5 * b.mass[k] * dot(b.velocity[k], b.velocity[k]) + 0.5 * b.inertia[k] * b.spin[k] * b.spin[k];
  return sum;
}

class MarginalContact : public testing::TestWithParam<double> {};

TEST_P(MarginalContact, ComesToRest) {
  LawScene law;
  law.attraction = GetParam();
  State<Disks> s = marginal_row(law);
  Solver solver(s, {});
  solver.run(100);
  solver.snapshot(s);
  const double early = kinetic_energy(s.packing.bodies);
  solver.run(100'000);
  solver.snapshot(s);
  const double rounding = std::numeric_limits<double>::epsilon() * 3;  // [a] of a position
  const double floor = s.law.normal_stiffness * rounding * rounding;   // [F0 a]
  EXPECT_GT(early, 1e6 * floor);
  EXPECT_LT(kinetic_energy(s.packing.bodies), 100 * floor);
}

INSTANTIATE_TEST_SUITE_P(Attraction, MarginalContact, testing::Values(0.0, 1.0));

}  // namespace
}  // namespace isostat
