// The measurement of soft-particles (seed 000, Sec. 4): exact laws that it must obey.
#include "dem/spheres/lab/soft_particle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "dem/run_error.hpp"

namespace isostat {
namespace {

// A small and loose particle: some hundred grains would take their time.
SoftParticleTest small(SoftPartner partner, SoftProtocol protocol = SoftProtocol::fire) {
  SoftParticleTest t = soft_particle_defaults(partner, protocol);
  t.insertion.radius_min = 0.25 * t.insertion.radius_max;
  t.insertion.trials = 1000;
  t.delta = {0.15, 0.3};
  return t;
}

// PHYSICS.md 3: 2.9654, 8.3873, 15.4085 N, from F = 4/3 E* sqrt(R) h^(3/2).
TEST(SoftParticle, ASolidSphereFollowsHertz) {
  for (const SoftProtocol protocol : {SoftProtocol::paper, SoftProtocol::quasistatic, SoftProtocol::fire}) {
    SoftParticleTest t = soft_particle_defaults(SoftPartner::none, protocol);
    t.delta = {0.1, 0.2, 0.3};
    const SoftMeasurement m = measure_soft_particle(t, 1);
    ASSERT_EQ(m.normal.size(), 3u);
    for (const NormalPoint& p : m.normal) {
      const double reduced = 5e5 / (2 * (1 - 0.09)), radius = 0.016, overlap = p.delta * radius;
      EXPECT_NEAR(p.force, 4.0 / 3 * reduced * std::sqrt(radius) * std::pow(overlap, 1.5), 1e-9 * p.force);
    }
    EXPECT_NEAR(m.normal[0].force, 2.9654, 1e-4 * 2.9654);
    EXPECT_NEAR(m.normal[1].force, 8.3873, 1e-4 * 8.3873);
    EXPECT_NEAR(m.normal[2].force, 15.4085, 1e-4 * 15.4085);
  }
}

TEST(SoftParticle, IsAPureFunctionOfItsSeed) {
  for (const SoftPartner partner : {SoftPartner::wall, SoftPartner::soft}) {
    SoftParticleTest t = small(partner);
    t.alpha = {-3, 3};
    const SoftMeasurement a = measure_soft_particle(t, 3), b = measure_soft_particle(t, 3),
                          other = measure_soft_particle(t, 4);
    for (std::size_t k = 0; k < t.delta.size(); ++k) EXPECT_EQ(a.normal[k].force, b.normal[k].force);
    ASSERT_EQ(a.tangential.size(), t.delta.size() * 3);
    for (std::size_t k = 0; k < a.tangential.size(); ++k) EXPECT_EQ(a.tangential[k].along, b.tangential[k].along);
    EXPECT_NE(a.normal.back().force, other.normal.back().force);
  }
}

// Pressed on six sides at once it is stiffer than on one: there is less room to give way to. And its law begins
// earlier.
TEST(SoftParticle, IsStifferInACage) {
  double wall = 0, cage = 0;
  for (std::uint64_t seed = 1; seed < 5; ++seed) {
    SoftParticleTest t = small(SoftPartner::wall);
    wall += measure_soft_particle(t, seed).normal.back().force;
    t.partner = SoftPartner::cage;
    cage += measure_soft_particle(t, seed).normal.back().force;
  }
  EXPECT_GT(cage, 1.2 * wall);
}

// Dimensions: with every length four times as large forces are sixteen times as large at the same Delta. Times grow by
// four, too, so that speeds stay; all factors are powers of two but for those in roots of the grains' radii.
TEST(SoftParticle, ForcesScaleWithTheSquareOfTheShell) {
  SoftParticleTest t = small(SoftPartner::wall);
  const SoftMeasurement one = measure_soft_particle(t, 1);
  t.insertion.shell_radius *= 4, t.insertion.radius_min *= 4, t.insertion.radius_max *= 4;
  const SoftMeasurement four = measure_soft_particle(t, 1);
  EXPECT_EQ(four.grains, one.grains);
  for (std::size_t k = 0; k < t.delta.size(); ++k)
    EXPECT_NEAR(four.normal[k].force, 16 * one.normal[k].force, 1e-6 * four.normal[k].force);
}

TEST(SoftParticle, PushesMoreTheDeeperAndIsAtRestWhenItIsMeasured) {
  for (const SoftPartner partner : {SoftPartner::wall, SoftPartner::soft}) {
    SoftParticleTest t = soft_particle_defaults(partner, SoftProtocol::fire);
    t.delta = {0.2, 0.4};  // two soft ones hardly push below .15 (Table 1)
    t.relaxation.most_iterations = 20000;
    const SoftMeasurement m = measure_soft_particle(t, 2);
    EXPECT_GT(m.normal[1].force, 0.05);
    EXPECT_GT(m.normal[1].force, 2 * m.normal[0].force);
    EXPECT_LT(m.normal[1].residual, t.relaxation.residual);
    EXPECT_NEAR(m.solid_fraction, 0.715, 0.03);  // PHYSICS.md 3
  }
}

// A rotation drags the partner along the slip of the contact, and turns round with its sense.
TEST(SoftParticle, ARotationPullsAlongItsSlip) {
  SoftParticleTest t = small(SoftPartner::wall);
  t.delta = {0.3};
  t.alpha = {-4, 4};
  double forward = 0, backward = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const SoftMeasurement m = measure_soft_particle(t, seed);
    ASSERT_EQ(m.tangential.size(), 3u);
    EXPECT_EQ(m.tangential[0].normal, m.normal[0].force);
    forward += m.tangential[2].along - m.tangential[0].along;
    backward += m.tangential[1].along - m.tangential[0].along;
  }
  EXPECT_GT(forward, 0);
  EXPECT_LT(backward, 0);
}

TEST(SoftParticle, BlownUpItIsMeasuredAgainWithASmallerStep) {
  SoftParticleTest t = small(SoftPartner::wall);
  t.relaxation.step = 8;
  const SoftMeasurement m = measure_soft_particle(t, 1);
  EXPECT_LT(m.step, 8);
  t.relaxation.step = m.step;
  EXPECT_EQ(measure_soft_particle(t, 1).normal.back().force, m.normal.back().force);
  t.relaxation.step = 100;
  EXPECT_THROW(measure_soft_particle(t, 1), RunError);
}

// Friction carries most of the load (PHYSICS.md 3: without it F falls to a third or less).
TEST(SoftParticle, FrictionCarriesTheLoad) {
  SoftParticleTest rough = soft_particle_defaults(SoftPartner::wall, SoftProtocol::fire);
  rough.delta = {0.2};
  SoftParticleTest smooth = rough;
  smooth.law.friction = smooth.law.wall_friction = smooth.law.tangential_damping = 0;
  EXPECT_GT(measure_soft_particle(rough, 1).normal[0].force, 2 * measure_soft_particle(smooth, 1).normal[0].force);
}

}  // namespace
}  // namespace isostat
