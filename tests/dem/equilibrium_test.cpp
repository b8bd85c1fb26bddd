#include "dem/disks/at_rest.hpp"
#include "dem/disks/certificate.hpp"
#include "dem/state/balance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/oracle/network_oracle.hpp"

namespace isostat {
namespace {

DiskLaw cohesive_law() {
  DiskLaw law;
  law.normal_stiffness = law.tangential_stiffness = 1e5;
  law.damping = 0.8, law.friction = 0.5;
  law.rolling_friction = 0.005, law.rolling_stiffness = 10;
  law.attraction = 1, law.attraction_range = 1e-3;
  return law;
}

DiskLaw cohesionless_law() {
  DiskLaw law = cohesive_law();
  law.attraction = law.attraction_range = 0;
  return law;
}

// Two disks of diameter a at the gap h, with the law's normal force.
Packing<2> pair_at(double gap, const DiskLaw& law) {
  Packing<2> p;
  p.bodies.resize(2);
  p.bodies.id = {1, 2};
  p.bodies.radius = {0.5, 0.5};
  p.bodies.mass = {1, 1};
  p.bodies.inertia = {0.125, 0.125};
  p.bodies.position = {Vec2{{0, 0}}, Vec2{{1 + gap, 0}}};
  Link<2> l;
  l.j = 1, l.gap = gap, l.kind = kind_of(law, gap, 0, 0), l.normal_force = at_rest(law, gap).force;
  p.links = {l};
  return p;
}

TEST(Certificate, EachDirectionHasItsOwnStress) {
  EXPECT_EQ(force_scale(cohesive_law(), {std::nullopt, -3.0}), 3);
  EXPECT_EQ(largest_stress(ImposedStress<2>{0.5, -2.0}), -2.0);
  EXPECT_FALSE(largest_stress(ImposedStress<2>{}));
}

TEST(Equilibrium, StickingPairAtZeroForceIsBalanced) {
  const DiskLaw law = cohesive_law();
  const Certificate c = evaluate_certificate(pair_at(-1e-5, law), law, {}, {});
  EXPECT_NEAR(c.max_force, 0, 1e-9);
  EXPECT_EQ(c.max_moment, 0);
  EXPECT_FALSE(c.pressure_controlled);
  EXPECT_TRUE(c.equilibrated);
  EXPECT_EQ(c.force_scale, 1);
  EXPECT_EQ(c.smallest_margin, 1);
}

TEST(Equilibrium, NormalForceFollowsTheLawThroughContactAndRange) {
  const DiskLaw law = cohesive_law();
  EXPECT_DOUBLE_EQ(at_rest(law, -3e-5).force, 2);
  EXPECT_DOUBLE_EQ(at_rest(law, 0).force, -1);
  EXPECT_DOUBLE_EQ(at_rest(law, 5e-4).force, -0.5);
  EXPECT_EQ(at_rest(law, 1.1e-3).force, 0);
  EXPECT_EQ(at_rest(cohesionless_law(), 1e-4).force, 0);
}

TEST(Equilibrium, UnbalancedPairReportsItsForceInF1) {
  DiskLaw law = cohesive_law();
  law.attraction = 4;
  const Certificate c = evaluate_certificate(pair_at(-5e-5, law), law, {}, {});  // N = 5 - 4
  EXPECT_DOUBLE_EQ(c.force_scale, 4);
  EXPECT_NEAR(c.max_force, 0.25, 1e-12);
  EXPECT_FALSE(c.equilibrated);
  EXPECT_EQ(worst_criterion(c).name, "force");
  EXPECT_NEAR(worst_criterion(c).ratio, 2500, 1e-6);
}

TEST(Equilibrium, ForceScaleIsTheLargerOfAttractionAndPressure) {
  EXPECT_EQ(force_scale(cohesive_law(), isotropic<2>(0.01)), 1);
  EXPECT_EQ(force_scale(cohesive_law(), isotropic<2>(3.0)), 3);
  EXPECT_EQ(force_scale(cohesionless_law(), isotropic<2>(0.2)), 0.2);
  EXPECT_EQ(force_scale(cohesionless_law(), {}), 1);
}

TEST(Equilibrium, NetLoadsAndStressMatchTheContactPointOracle) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Packing<2> p = oracle::random_packing(seed, 12, 40, seed % 2 == 0);
    double force = 0, moment = 0;
    for (const oracle::NetLoad& l : oracle::net_loads(p))
      force = std::max(force, norm(l.force)), moment = std::max(moment, std::abs(l.moment));
    const Certificate c = evaluate_certificate(p, cohesive_law(), {}, {});
    EXPECT_NEAR(c.max_force, force, 1e-13 * force);
    EXPECT_NEAR(c.max_moment, moment, 1e-13 * moment);
  }
}

TEST(Equilibrium, MarginCountsAndKindsAgree) {
  const DiskLaw law = cohesive_law();
  const double h = -2e-5, elastic = 2, limit_t = law.friction * elastic, limit_m = law.rolling_friction * elastic;
  EXPECT_EQ(kind_of(law, h, 0.5 * limit_t, 0), LinkKind::closed);
  EXPECT_EQ(kind_of(law, h, -limit_t * (1 - 0.9e-6), 0), LinkKind::sliding);
  EXPECT_EQ(kind_of(law, h, limit_t * (1 - 1.1e-6), 0), LinkKind::closed);
  EXPECT_EQ(kind_of(law, h, 0, limit_m), LinkKind::rolling_yielded);
  EXPECT_EQ(kind_of(law, h, limit_t, -limit_m), LinkKind::both_yielded);
  EXPECT_EQ(kind_of(law, 0, 0, 0), LinkKind::distant);

  Packing<2> p = pair_at(h, law);
  p.links[0].tangential_force = 0.75 * limit_t;
  p.links[0].moment = -0.25 * limit_m;
  Certificate c = evaluate_certificate(p, law, {}, {});
  EXPECT_NEAR(c.smallest_margin, 0.25, 1e-12);
  EXPECT_EQ(c.sliding, 0);
  p.links[0].tangential_force = -limit_t, p.links[0].moment = limit_m;
  c = evaluate_certificate(p, law, {}, {});
  EXPECT_EQ(c.sliding, 1);
  EXPECT_EQ(c.rolling_yielded, 1);
  EXPECT_NEAR(c.smallest_margin, 0, 1e-12);

  DiskLaw frictionless = law;
  frictionless.friction = frictionless.rolling_friction = 0;
  EXPECT_EQ(evaluate_certificate(pair_at(h, law), frictionless, {}, {}).sliding, 0);
}

TEST(Equilibrium, SpinningRattlersDoNotHoldUpACohesionlessPacking) {
  const DiskLaw law = cohesionless_law();
  Packing<2> p = pair_at(-1e-12, law);  // N = 1e-7
  p.bodies.resize(3);
  p.bodies.id[2] = 3, p.bodies.position[2] = {{5, 5}};
  p.bodies.radius[2] = 0.5, p.bodies.mass[2] = 1, p.bodies.inertia[2] = 0.125, p.bodies.spin[2] = 1;
  EXPECT_TRUE(evaluate_certificate(p, law, {}, {}).equilibrated);
  // ... but a cohesive one counts every grain: 0.5 * 0.125 / 3 of F0 a per grain.
  const Certificate c = evaluate_certificate(p, cohesive_law(), {}, {});
  EXPECT_DOUBLE_EQ(c.kinetic_energy_per_grain, 0.5 * 0.125 / 3);
  // and a gas without any contact is not at rest
  p.links.clear();
  EXPECT_FALSE(evaluate_certificate(p, law, {}, {}).equilibrated);
}

// Square lattice of touching disks, one grain a cell: two self-contacts with forces N1, N2; sigma_11 = N1 L1 / (L1 L2).
TEST(Equilibrium, SquareLatticeCarriesItsPressure) {
  const DiskLaw law = cohesionless_law();
  Packing<2> p;
  const double overlap = 1e-5, side = 1 - overlap, n = law.normal_stiffness * overlap;
  p.cell = PeriodicCell<2>{{{side, side}}};
  p.bodies.resize(1);
  p.bodies.radius = {0.5}, p.bodies.mass = {1}, p.bodies.inertia = {0.125};
  for (int axis : {0, 1}) {
    Link<2> l;
    l.shift[static_cast<std::size_t>(axis)] = 1, l.gap = -overlap, l.normal_force = n;
    p.links.push_back(l);
  }
  const StressTensor s = measured_stress(p);
  EXPECT_NEAR(s.xx, n / side, 1e-14);
  EXPECT_NEAR(s.yy, n / side, 1e-14);
  EXPECT_EQ(s.xy, 0);
  EXPECT_TRUE(evaluate_certificate(p, law, isotropic<2>(n / side), {}).equilibrated);
  const Certificate off = evaluate_certificate(p, law, isotropic<2>(n / side + 2e-4), {});
  EXPECT_NEAR(off.pressure_error, 2e-4 / (n / side + 2e-4), 1e-10);
  EXPECT_FALSE(off.equilibrated);
  p.bodies.velocity[0] = {{0.3, 0}};  // the kinetic part counts in the stress
  EXPECT_NEAR(measured_stress(p).xx, n / side + 0.09 / (side * side), 1e-13);
}

TEST(Equilibrium, NotANumberIsNeverBalanced) {
  const DiskLaw law = cohesive_law();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Packing<2> p = pair_at(-1e-5, law);
  p.links[0].normal_force = nan;
  EXPECT_FALSE(evaluate_certificate(p, law, {}, {}).equilibrated);
  p = pair_at(-1e-5, law);
  p.bodies.velocity[1][0] = nan;
  const Certificate c = evaluate_certificate(p, law, {}, {});
  EXPECT_FALSE(c.equilibrated);
  EXPECT_EQ(worst_criterion(c).name, "kinetic energy");
}

}  // namespace
}  // namespace isostat
