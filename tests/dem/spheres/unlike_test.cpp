// Bodies of several kinds: grains of two materials, soft-particles, shells.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dem/spheres/at_rest.hpp"
#include "dem/spheres/engine.hpp"
#include "tests/support/machine_isas.hpp"
#include "tests/support/sphere_states.hpp"

namespace isostat {
namespace {

SphereLaw elastic_law() {
  SphereLaw law;
  law.grain = law.wall = {1e6, 0.3};
  law.second = {2.5e5, 0.2};
  law.soft_solid = {0.6, 2.8, -2e-4, 4, 2.1, 0.25};
  law.soft_soft = {0.25, 5, -2e-5, 3, 4.4, 0.4};
  law.soft_curvature = 0.4;
  return law;
}
SphereLaw frictional_law() {
  SphereLaw law = elastic_law();
  law.friction = law.wall_friction = 0.5;
  return law;
}

struct Pair {
  SphereKind first, second;
};

// Two bodies along a skew line, the second moving towards the first, one image away in a cell.
State<Spheres> two_bodies(const SphereLaw& law, SphereKind first, SphereKind second, double gap, double speed) {
  State<Spheres> s;
  s.law = law;
  const Vec3 n{{2.0 / 3, 2.0 / 3, 1.0 / 3}};
  oracle::add_sphere(s.packing, 0.5, {});
  oracle::add_sphere(s.packing, 0.7, (1.2 + gap) * n, -speed * n);
  s.packing.kind = {first, second};
  s.time_step = 1e-6;
  return s;
}

double energy(const State<Spheres>& s) {
  const SpherePacking& p = s.packing;
  double sum = 0;
  for (std::size_t k = 0; k < p.bodies.size(); ++k)
    sum += 0.5 * p.bodies.mass[k] * dot(p.bodies.velocity[k], p.bodies.velocity[k]) +
           0.5 * p.bodies.inertia[k] * dot(p.bodies.spin[k], p.bodies.spin[k]);
  for (const Link<3>& l : p.links) {
    const ContactStiffness c = pair_stiffness(s.law, body_of(p, l.i), body_of(p, l.j));
    sum += at_rest(s.law, c, l.gap).elastic + spring_energy(s.law, c, l.gap, l.tangential_force, {}).tangential;
  }
  return sum;
}

const std::vector<Pair> kPairs{{SphereKind::grain, SphereKind::grain},   {SphereKind::grain, SphereKind::second},
                               {SphereKind::second, SphereKind::second}, {SphereKind::grain, SphereKind::soft},
                               {SphereKind::second, SphereKind::soft},   {SphereKind::soft, SphereKind::soft}};

// Formulas of the laws, written out.
TEST(UnlikeSpheres, HaveTheForcesOfTheirLaws) {
  const SphereLaw law = elastic_law();
  const double d = 0.12, r1 = 0.5, r2 = 0.7, reduced = r1 * r2 / (r1 + r2);
  const auto hertz = [&](double e1, double nu1, double e2, double nu2) {
    return 4.0 / 3 / ((1 - nu1 * nu1) / e1 + (1 - nu2 * nu2) / e2) * std::sqrt(reduced) * std::pow(d, 1.5);
  };
  const double share = std::pow(r1 / (r1 + r2), 0.4), both = 2 * reduced;
  const std::vector<double> expected{hertz(1e6, 0.3, 1e6, 0.3),
                                     hertz(1e6, 0.3, 2.5e5, 0.2),
                                     hertz(2.5e5, 0.2, 2.5e5, 0.2),
                                     1e6 * r2 * r2 * share * (0.6 * std::pow(d / r2, 2.8) - 2e-4),
                                     1e6 * r2 * r2 * share * (0.6 * std::pow(d / r2, 2.8) - 2e-4),
                                     1e6 * both * both * (0.25 * std::pow(d / both, 5) - 2e-5)};
  for (std::size_t k = 0; k < kPairs.size(); ++k) {
    State<Spheres> s = two_bodies(law, kPairs[k].first, kPairs[k].second, -d, 0);
    for (const Isa isa : machine_isas()) {
      Solver solver(s, {}, {.isa = isa});
      EXPECT_NEAR(norm(solver.engine().force_between(0, 0)), 0, 1e-9 * expected[k]);  // of a group on itself
      State<Spheres> after = s;
      solver.snapshot(after);
      ASSERT_EQ(after.packing.links.size(), 1u);
      EXPECT_NEAR(after.packing.links[0].normal_force, expected[k], 1e-12 * expected[k]);
      EXPECT_NEAR(norm(after.memory.force[1]), expected[k], 1e-12 * expected[k]);
    }
  }
}

// Below its threshold a soft-particle bears nothing; at it force and energy begin without a jump.
TEST(UnlikeSpheres, SoftParticlesHaveAThreshold) {
  const SphereLaw law = elastic_law();
  const SoftContact c = soft_contact(law.soft_solid, 1e6, 0.7, 1);
  const double delta = std::pow(2e-4 / 0.6, 1 / 2.8);
  EXPECT_DOUBLE_EQ(c.threshold, delta);
  EXPECT_EQ(soft_force(c, 0.999 * delta * 0.7).force, 0);
  EXPECT_EQ(soft_force(c, 0.999 * delta * 0.7).stiffness, 0);
  EXPECT_GT(soft_force(c, 1.001 * delta * 0.7).force, 0);
  const double x = 0.15, h = 1e-6;
  EXPECT_NEAR((soft_energy(c, x + h) - soft_energy(c, x - h)) / (2 * h), soft_force(c, x).force,
              1e-6 * soft_force(c, x).force);
  EXPECT_NEAR((soft_force(c, x + h).force - soft_force(c, x - h).force) / (2 * h), soft_force(c, x).stiffness,
              1e-6 * soft_force(c, x).stiffness);
}

// Both marched for 500 steps on this instruction set end alike, to the rounding of positions; spins to 100 times that.
void expect_same_motion(State<Spheres> a, State<Spheres> b, Isa isa, double rounding) {
  Solver one(a, {}, {.isa = isa}), other(b, {}, {.isa = isa});
  one.run(500), other.run(500);
  one.snapshot(a), other.snapshot(b);
  EXPECT_GT(a.packing.links.size(), 30u);
  for (std::size_t k = 0; k < a.packing.bodies.size(); ++k) {
    EXPECT_NEAR(norm(a.packing.bodies.position[k] - b.packing.bodies.position[k]), 0, rounding);
    EXPECT_NEAR(norm(a.packing.bodies.spin[k] - b.packing.bodies.spin[k]), 0, 100 * rounding);
  }
}

// The kernel of unlike bodies, given bodies that are all alike, does what the other one does, to rounding.
TEST(UnlikeSpheres, AreNoOtherLawForGrainsThatAreAlike) {
  oracle::RandomSpheres r;
  r.law = oracle::soft_sphere_law();
  r.law.attraction = r.law.attraction_range = r.law.rolling_friction = r.law.rolling_stiffness = 0;
  r.room = 0.5;
  const State<Spheres> alike = oracle::random_state(r);
  State<Spheres> unlike = alike;
  unlike.packing.kind.assign(unlike.packing.bodies.size(), SphereKind::grain);
  for (const Isa isa : machine_isas()) expect_same_motion(alike, unlike, isa, 1e-11);
}

// Given Hertz's and Mindlin's law as powers, soft-particles are grains.
TEST(UnlikeSpheres, ASoftParticleUnderHertzsLawIsAGrain) {
  oracle::RandomSpheres r;
  r.law = oracle::soft_sphere_law();
  r.law.attraction = r.law.attraction_range = r.law.rolling_friction = r.law.rolling_stiffness = 0;
  r.room = 0.5, r.radius_min = r.radius_max = 0.45;
  const double e = r.law.grain.modulus, reduced = reduced_modulus(r.law.grain, r.law.grain) / e,
               shear = reduced_shear_modulus(r.law.grain, r.law.grain) / e;
  // R* = R_s R/(R + R_s); two of one radius have half of it.
  r.law.soft_solid = {4.0 / 3 * reduced, 1.5, 0, 8 * shear, 0.5, r.law.friction};
  r.law.soft_soft = {4.0 / 3 * reduced * std::sqrt(0.5), 1.5, 0, 8 * shear * std::sqrt(0.5), 0.5, r.law.friction};
  r.law.soft_curvature = 0.5;
  const State<Spheres> grains = oracle::random_state(r);
  for (const int every : {1, 2}) {
    State<Spheres> soft = grains;
    for (std::size_t k = 0; k < soft.packing.bodies.size(); ++k)
      soft.packing.kind.push_back(k % static_cast<std::size_t>(every) == 0 ? SphereKind::soft : SphereKind::grain);
    expect_same_motion(grains, soft, best_isa(), 1e-10);
  }
}

// A central collision without damping gives the energy back, whatever meets what.
TEST(UnlikeSpheres, CollideElastically) {
  for (const Pair pair : kPairs) {
    State<Spheres> s = two_bodies(elastic_law(), pair.first, pair.second, 1e-4, 20);
    const double before = energy(s);
    Solver solver(s, {}, {});
    double pressed = 0;
    for (int k = 0; k < 400; ++k) {
      solver.run(100);
      solver.snapshot(s);
      for (const Link<3>& l : s.packing.links) pressed = std::max(pressed, -l.gap);
      EXPECT_NEAR(energy(s), before, 2e-5 * before);
    }
    EXPECT_GT(pressed, 0.02);
    EXPECT_TRUE(s.packing.links.empty());
  }
}

// Oblique, with friction and without damping: energy is lost to sliding and to springs that soften, never gained, and
// momenta are kept.
TEST(UnlikeSpheres, SlideWithoutGainingEnergy) {
  for (const Pair pair : kPairs) {
    State<Spheres> s = two_bodies(frictional_law(), pair.first, pair.second, 1e-4, 15);
    s.packing.bodies.velocity[1] += Vec3{{4, -3, -2}};
    s.packing.bodies.spin[0] = {{3, -5, 8}};
    double last = energy(s);
    const double before = last;
    const auto turning = [&s] {
      Vec3 sum{};
      const Bodies<3>& b = s.packing.bodies;
      for (std::size_t k = 0; k < 2; ++k)
        sum += b.mass[k] * cross(b.position[k], b.velocity[k]) + b.inertia[k] * b.spin[k];
      return sum;
    };
    const Vec3 turned = turning();
    Solver solver(s, {}, {});
    for (int k = 0; k < 1500; ++k) {
      solver.run(100);
      solver.snapshot(s);
      EXPECT_LT(energy(s), last + 2e-5 * before);
      last = energy(s);
    }
    EXPECT_TRUE(s.packing.links.empty());
    EXPECT_LT(last, 0.995 * before);
    EXPECT_NEAR(norm(turning() - turned), 0, 1e-3 * norm(turned));
  }
}

// A shell around a grain: alone they keep energy, momentum and angular momentum.
State<Spheres> grain_in_shell(const SphereLaw& law, double shell_mass) {
  State<Spheres> s;
  s.law = law;
  oracle::add_sphere(s.packing, 2, {{0.1, 0.2, 0.3}}, {}, {{0, 0.5, 0}});
  oracle::add_sphere(s.packing, 0.5, {{1.1, -0.4, 0.3}}, {{5, 2, -1}}, {{1, 2, 3}});
  Bodies<3>& b = s.packing.bodies;
  b.radius[0] = -2, b.mass[0] = shell_mass, b.inertia[0] = 0.4 * shell_mass * 4;
  s.packing.kind = {SphereKind::shell, SphereKind::grain};
  s.packing.group = {1, 1};
  s.time_step = 2e-6;
  return s;
}

TEST(UnlikeSpheres, AShellIsABodyThatItsGrainMoves) {
  for (const SphereLaw& law : {elastic_law(), frictional_law()}) {
    State<Spheres> s = grain_in_shell(law, 3);
    const auto momentum = [&s] {
      return s.packing.bodies.mass[0] * s.packing.bodies.velocity[0] +
             s.packing.bodies.mass[1] * s.packing.bodies.velocity[1];
    };
    const auto turning = [&s] {
      Vec3 sum{};
      const Bodies<3>& b = s.packing.bodies;
      for (std::size_t k = 0; k < 2; ++k)
        sum += b.mass[k] * cross(b.position[k], b.velocity[k]) + b.inertia[k] * b.spin[k];
      return sum;
    };
    Solver solver(s, {}, {});
    const Vec3 moved = momentum(), turned = turning();
    const double before = energy(s);
    int touches = 0;
    for (int k = 0; k < 500; ++k) {
      solver.run(1000);
      solver.snapshot(s);
      touches += !s.packing.links.empty();
      EXPECT_NEAR(norm(momentum() - moved), 0, 1e-9 * norm(moved));
      EXPECT_NEAR(norm(turning() - turned), 0, 2e-3 * norm(turned));
      if (law.friction == 0)
        EXPECT_NEAR(energy(s), before, 1e-4 * before);
      else
        EXPECT_LT(energy(s), before * (1 + 1e-4));
      EXPECT_LT(norm(s.packing.bodies.position[1] - s.packing.bodies.position[0]), 1.6);
    }
    EXPECT_GT(touches, 5);
  }
}

// One that nothing moves is a wall of that shape.
TEST(UnlikeSpheres, AHeavyShellIsAWall) {
  State<Spheres> shell = grain_in_shell(frictional_law(), 1e20);
  shell.packing.bodies.spin[0] = shell.packing.bodies.spin[1] = {};
  shell.packing.bodies.velocity[1][2] = 0;  // a plane motion: the grain does not turn about the normal
  shell.law.damping = 0.3, shell.law.tangential_damping = 0.5;
  // Hard: lever arms differ by the order of the overlap, since those of pairs are shares of the distance.
  shell.law.grain.modulus = shell.law.wall.modulus = 1e10;
  shell.packing.bodies.position[1] = {{1.5, -0.2, 0.3}};
  shell.time_step = 7e-8;
  State<Spheres> wall;
  wall.law = shell.law, wall.time_step = shell.time_step;
  oracle::add_sphere(wall.packing, 0.5, shell.packing.bodies.position[1], shell.packing.bodies.velocity[1],
                     shell.packing.bodies.spin[1]);
  wall.packing.walls.resize(1);
  wall.packing.walls[0].shape = WallShape::shell, wall.packing.walls[0].radius = 2;
  wall.packing.walls[0].point = shell.packing.bodies.position[0];
  Solver a(shell, {}, {}), b(wall, {}, {});
  for (int k = 0; k < 300; ++k) {
    a.run(6000), b.run(6000);
    a.snapshot(shell), b.snapshot(wall);
    EXPECT_NEAR(norm(shell.packing.bodies.position[1] - wall.packing.bodies.position[0]), 0, 3e-4);
    EXPECT_NEAR(norm(shell.packing.bodies.spin[1] - wall.packing.bodies.spin[0]), 0, 1e-2);
  }
}

// Pressed on by its own weight in the frame that turns with a heavy shell, a grain stays where it is: nothing slips, no
// spring is stretched, whatever the axis.
TEST(UnlikeSpheres, ShellAndGrainTurnAsOne) {
  State<Spheres> s = grain_in_shell(frictional_law(), 1e20);
  Bodies<3>& b = s.packing.bodies;
  const Vec3 w{{0, 3, 4}}, n{{1, 0, 0}};  // the grain goes round the equator
  const double reach = 2 - 0.5, hertz = pair_stiffness(s.law, body_of(s.packing, 0), body_of(s.packing, 1)).normal;
  double d = 0;
  for (int k = 0; k < 50; ++k) d = std::pow(b.mass[1] * dot(w, w) * (reach + d) / hertz, 2.0 / 3);
  b.position[0] = {}, b.position[1] = (reach + d) * n;
  b.spin[0] = b.spin[1] = w;
  b.velocity[0] = {}, b.velocity[1] = cross(w, b.position[1]);
  s.time_step = 1e-6;
  Solver solver(s, {}, {});
  for (int k = 0; k < 10; ++k) {
    solver.run(200000);  // two turns in all, and more
    solver.snapshot(s);
    ASSERT_EQ(s.packing.links.size(), 1u);
    const Link<3>& l = s.packing.links[0];
    EXPECT_NEAR(l.normal_force, b.mass[1] * 25 * (reach + d), 1e-3 * l.normal_force);
    EXPECT_LT(norm(l.tangential_force), 1e-3 * l.normal_force);
    EXPECT_NEAR(norm(s.packing.bodies.velocity[1]), 5 * (reach + d), 1e-4);
  }
}

// Of groups: no shell knows another one, or the grains of another one.
TEST(UnlikeSpheres, ShellsAreThereForTheirGroupAlone) {
  State<Spheres> s = grain_in_shell(elastic_law(), 3);
  s.packing.group = {1, 2};
  s.packing.bodies.spin[0] = {};
  const Vec3 v = s.packing.bodies.velocity[1];
  Solver solver(s, {}, {});
  solver.run(400000);
  solver.snapshot(s);
  EXPECT_EQ(s.packing.bodies.velocity[1], v);
  EXPECT_EQ(s.packing.bodies.velocity[0], Vec3{});
}

// A grain between two balls as heavy as walls, against one between two grains that nothing moves.
TEST(UnlikeSpheres, ABallIsAGrainThatNothingMoves) {
  State<Spheres> wall;
  wall.law = frictional_law();
  wall.law.damping = 0.3, wall.law.tangential_damping = 0.5;
  wall.law.grain.modulus = wall.law.wall.modulus = 1e10;  // see AHeavyShellIsAWall
  wall.time_step = 7e-8;
  oracle::add_sphere(wall.packing, 0.5, {{0, 0, 1.300001}}, {{1, 0.5, -8}}, {{2, 0, 1}});
  State<Spheres> grain = wall;
  wall.packing.walls.resize(1);
  wall.packing.walls[0].shape = WallShape::ball, wall.packing.walls[0].radius = 0.8;
  oracle::add_sphere(grain.packing, 0.8, {});
  grain.packing.bodies.mass[1] *= 1e20, grain.packing.bodies.inertia[1] *= 1e20;
  Solver a(wall, {}, {}), b(grain, {}, {});
  bool touched = false;
  for (int k = 0; k < 100; ++k) {
    a.run(60), b.run(60);
    a.snapshot(wall), b.snapshot(grain);
    touched = touched || !wall.packing.wall_links.empty();
    EXPECT_EQ(wall.packing.wall_links.size(), grain.packing.links.size());
    EXPECT_NEAR(norm(wall.packing.bodies.velocity[0] - grain.packing.bodies.velocity[0]), 0, 2e-3);
    EXPECT_NEAR(norm(wall.packing.bodies.spin[0] - grain.packing.bodies.spin[0]), 0, 2e-2);
  }
  EXPECT_TRUE(touched);
}

}  // namespace
}  // namespace isostat
