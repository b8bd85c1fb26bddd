// Long implicit steps of what moves without resistance: a spinning pair stays a pair, and a capture is foreseen.
#include "analysis/finishing/implicit_step.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "dem/disks/sample.hpp"

namespace isostat {
namespace {

constexpr double kStiffness = 1e5;              // K_N [F0/a]
constexpr double kDeflection = 1 / kStiffness;  // h0 [a] of a contact that carries no force
constexpr StepTolerance kTolerance{1e-7, 0};    // [F0]

// Two cohesive disks on a line, `gap` [a] apart, at rest.
State<Disks> pair(double gap) {
  Scene scene;
  scene.grains.count = 2;
  scene.law.normal_stiffness = kStiffness;
  scene.law.attraction = 1, scene.law.attraction_range = 1e-3;
  State<Disks> s = initial_disks(scene, 1);
  Bodies<2>& b = s.packing.bodies;
  s.packing.cell->length = {{8, 8}};
  b.position = {{{3, 4}}, {{3 + b.radius[0] + b.radius[1] + gap, 4}}};
  b.velocity = {{{0, 0}}, {{0, 0}}};
  b.spin = {0, 0};
  return s;
}
double gap(const State<Disks>& s) {
  const Bodies<2>& b = s.packing.bodies;
  return norm(b.position[1] - b.position[0]) - b.radius[0] - b.radius[1];
}
Vec2 momentum(const State<Disks>& s) {
  const Bodies<2>& b = s.packing.bodies;
  return b.mass[0] * b.velocity[0] + b.mass[1] * b.velocity[1];
}

// In each step the branch vector turns by .06: a straight guess stretches the contact by 100 h0, a step along the last
// chord still by h0, and attraction would take over.
TEST(ImplicitStep, ASpinningPairStaysAPair) {
  State<Disks> s = pair(-kDeflection);
  Bodies<2>& b = s.packing.bodies;
  const double spin = 0.3, dt = 0.2, drift = 0.01;
  const int steps = 20;
  const Vec2 centre = (1 / (b.mass[0] + b.mass[1])) * (b.mass[0] * b.position[0] + b.mass[1] * b.position[1]);
  for (std::size_t k = 0; k < 2; ++k) {
    b.spin[k] = spin;
    b.velocity[k] = {{drift, spin * (b.position[k][0] - centre[0])}};
  }
  const Vec2 before = momentum(s);
  const FinishingRequest<2> request;
  SettlingNetwork network(s, request);
  ImplicitStep step(network, network.velocities(s), 0);
  for (int k = -2; k < steps; ++k) {  // two short steps first: the guess needs a history
    const StepOutcome o = step.take(k < 0 ? 0.05 : dt, kTolerance, Captures::refuse);
    ASSERT_TRUE(o.accepted) << k << ": " << o.refused;
    EXPECT_LE(o.iterations, 6) << k;
  }
  EXPECT_LE(step.factorisations(), steps + 4);
  network.store(s, step.velocity());
  EXPECT_NEAR(gap(s), -kDeflection, 0.1 * kDeflection);  // the centripetal force is a few hundredths of F0
  const Vec2 branch = b.position[1] - b.position[0];
  const double turned = std::atan2(branch[1], branch[0]), free = spin * (dt * steps + 0.1);
  EXPECT_LT(turned, free);
  EXPECT_GT(turned, 0.93 * free);  // backward Euler takes a part of about (spin dt)^2 of the energy in a step
  EXPECT_NEAR(momentum(s)[0], before[0], 1e-12);
  EXPECT_NEAR(momentum(s)[1], before[1], 1e-12);
  ASSERT_EQ(s.packing.links.size(), 1u);
  EXPECT_NE(s.packing.links[0].kind, LinkKind::distant);
}

TEST(ImplicitStep, ForeseesACapture) {
  State<Disks> s = pair(0.01);
  const double speed = 0.02;
  s.packing.bodies.velocity[0] = {{speed, 0}};
  const FinishingRequest<2> request;
  SettlingNetwork network(s, request);
  ImplicitStep step(network, network.velocities(s), 0);
  const double free_for = (0.01 - 1e-3) / speed;
  const StepOutcome o = step.take(2 * free_for, kTolerance, Captures::refuse);
  EXPECT_FALSE(o.accepted);
  ASSERT_TRUE(o.capture.has_value());
  EXPECT_NEAR(*o.capture, 0.5, 1e-9);
  // Nothing has moved, so that a shorter step ends short of it.
  EXPECT_TRUE(step.take(0.99 * free_for, kTolerance, Captures::refuse).accepted);
  network.store(s, step.velocity());
  EXPECT_NEAR(gap(s), 1e-3 + 0.01 * speed * free_for, 1e-9);
}

// The pattern of the tangent holds the links that act; a pair that comes to act is added.
TEST(ImplicitStep, ThePatternGrowsWithTheLinks) {
  State<Disks> s = pair(1.1e-3);
  s.packing.bodies.velocity[0] = {{0.02, 0}};
  const FinishingRequest<2> request;
  SettlingNetwork network(s, request);
  const std::size_t apart = network.shifted_stiffness(1).row.size();
  const std::int64_t patterns = network.patterns();
  ImplicitStep step(network, network.velocities(s), 0);
  ASSERT_TRUE(step.take(0.01, kTolerance, Captures::pass).accepted);
  EXPECT_EQ(network.shifted_stiffness(1).row.size(), apart + 9);
  EXPECT_EQ(network.patterns(), patterns + 1);
}

}  // namespace
}  // namespace isostat
