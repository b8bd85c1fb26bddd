#include "dem/state/container_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace isostat {
namespace {

constexpr double kPi = std::numbers::pi;

ContainerMotionScene shaken() {
  ContainerMotionScene m;
  m.vibration_amplitude = 0.2, m.vibration_frequency = 5;
  return m;
}

TEST(ContainerMotion, NothingMovesWithoutADrive) {
  const Surroundings from{{{0.1, -0.7}}, 0.3};
  const ContainerPlacement p = container_at({}, from, 17.3);
  EXPECT_EQ(p, (ContainerPlacement{{{0.1, -0.7}}, 0.3, {}, 0}));
  EXPECT_FALSE(moves({}));
}

TEST(ContainerMotion, AVibrationGoesDownByTwiceItsAmplitudeAndComesBack) {
  const ContainerMotionScene m = shaken();
  EXPECT_TRUE(moves(m));
  EXPECT_EQ(container_at(m, {}, 0), ContainerPlacement{});
  EXPECT_NEAR(container_at(m, {}, 0.1).offset[1], -0.4, 1e-15);
  EXPECT_NEAR(container_at(m, {}, 0.05).velocity[1], -0.2 * 10 * kPi, 1e-13);
  EXPECT_NEAR(container_at(m, {}, 0.2).offset[1], 0, 1e-15);
  EXPECT_EQ(container_at(m, {}, 0.07).offset[0], 0);
}

TEST(ContainerMotion, TheVelocityIsTheDerivativeOfThePlace) {
  ContainerMotionScene m = shaken();
  m.rotation = 1.7;
  const Surroundings from{{{0.5, 0.25}}, -0.4};
  const Vec2 r0{{1.25, -0.5}};
  const double t = 0.237, h = 1e-6;
  const Vec2 before = point_at(container_at(m, from, t - h), r0), after = point_at(container_at(m, from, t + h), r0);
  const ContainerPlacement p = container_at(m, from, t);
  const Vec2 v = velocity_at(p, point_at(p, r0));
  for (int a = 0; a < 2; ++a) EXPECT_NEAR(v[a], (after[a] - before[a]) / (2 * h), 1e-7);
  EXPECT_NEAR(p.angle, -0.4 + 1.7 * t, 1e-15);
  EXPECT_EQ(p.spin, 1.7);
}

TEST(ContainerMotion, APointKnowsWhereItWasBuilt) {
  ContainerMotionScene m = shaken();
  m.rotation = -0.6;
  const ContainerPlacement p = container_at(m, {{{0.1, 0.2}}, 0.9}, 3.21);
  const Vec2 r0{{-2.5, 0.75}}, back = built_at(p, point_at(p, r0));
  for (int a = 0; a < 2; ++a) EXPECT_NEAR(back[a], r0[a], 1e-14);
}

// A stage in two halves ends where the whole stage ends, if its vibration is whole at the cut.
TEST(ContainerMotion, TheNextStageBeginsWhereTheLastOneEnded) {
  ContainerMotionScene m = shaken();
  m.rotation = 0.3;
  Surroundings s{{{1, 2}}, 0.1, true, 5, 2.5, 8};
  const ContainerPlacement end = container_at(m, s, 0.27);
  bring_forward(s, m, 0.27);
  const ContainerPlacement next = container_at({}, s, 0);
  EXPECT_EQ(next.offset, end.offset);
  EXPECT_EQ(next.angle, end.angle);
  EXPECT_EQ(next.velocity, Vec2{});
  EXPECT_TRUE(s.open);
  EXPECT_EQ(s.grains_left, 5);
}

}  // namespace
}  // namespace isostat
