// Spheres at walls: closed forms of rolling, bouncing and resting; groups; walls that move.
#include <gtest/gtest.h>

#include <cmath>

#include "dem/input_error.hpp"
#include "dem/spheres/engine.hpp"
#include "tests/support/sphere_states.hpp"

namespace isostat {
namespace {

SphereLaw wall_law(NormalForce normal) {
  SphereLaw law;
  law.normal = normal;
  if (normal == NormalForce::hertz) law.grain = law.wall = {1e6, 0.3};
  if (normal == NormalForce::linear) law.normal_stiffness = 1e5, law.tangential_stiffness = 8e4;
  law.damping = 0.3, law.tangential_damping = 0.5, law.wall_friction = 0.3;
  return law;
}

SphereWall floor() {
  SphereWall wall;
  wall.normal = {{0, 0, 1}};
  return wall;
}
SphereWall shell(double radius) {
  SphereWall wall;
  wall.shape = WallShape::shell, wall.radius = radius, wall.group = 0;
  return wall;
}

// At rest under its weight: N = m g.
double resting_overlap(const SphereLaw& law, double radius, double weight) {
  const double c = wall_stiffness(law, radius).normal;
  return law.normal == NormalForce::hertz ? std::pow(weight / c, 2.0 / 3) : weight / c;
}

// Set down sliding, a sphere ends up rolling with v0/(1 + I/(m l^2)), 5/7 v0 if it is hard.
TEST(SphereWalls, SlidingBecomesRolling) {
  for (const NormalForce normal : {NormalForce::hertz, NormalForce::linear}) {
    State<Spheres> s;
    s.law = wall_law(normal);
    s.scene.gravity = 10;
    const double radius = 0.5, d = resting_overlap(s.law, radius, 10);
    oracle::add_sphere(s.packing, radius, {{0, 0, radius - d}}, {{0.6, 0.8, 0}});
    s.packing.walls = {floor()};
    s.time_step = 1e-4;
    Solver solver(s, {}, {});
    solver.run(20000);
    solver.snapshot(s);
    const Bodies<3>& b = s.packing.bodies;
    const double lever = radius - d, v = 1 / (1 + 0.4 * radius * radius / (lever * lever));
    EXPECT_NEAR(v, 5.0 / 7, 1e-3);
    EXPECT_NEAR(b.velocity[0][0], 0.6 * v, 1e-4);
    EXPECT_NEAR(b.velocity[0][1], 0.8 * v, 1e-4);
    EXPECT_NEAR(b.velocity[0][2], 0, 1e-8);
    EXPECT_NEAR(b.spin[0][0], -0.8 * v / lever, 1e-3);
    EXPECT_NEAR(b.spin[0][1], 0.6 * v / lever, 1e-3);
    EXPECT_NEAR(s.packing.wall_links.at(0).normal_force, 10, 1e-6);
    const Vec3 on_floor = solver.engine().force_on_wall(0);
    EXPECT_NEAR(on_floor[2], -10, 1e-6);
  }
}

// Like a pair with a partner of infinite mass: no loss without damping, Tsuji's with it.
TEST(SphereWalls, BounceLikePairs) {
  for (const double zeta : {0.0, 0.3})
    for (const bool inside_shell : {false, true}) {
      State<Spheres> s;
      s.law = wall_law(NormalForce::hertz);
      s.law.damping = zeta, s.law.wall_friction = 0;
      oracle::add_sphere(s.packing, 0.5, {{0, 0, 0.5 + 1e-9}}, {{0, 0, -1}});
      s.packing.walls = {inside_shell ? shell(3) : floor()};
      if (inside_shell) s.packing.walls[0].point = {{0, 0, 3}};
      s.time_step = 1e-5;
      Solver solver(s, {}, {});
      solver.run(4000);
      solver.snapshot(s);
      EXPECT_TRUE(s.packing.wall_links.empty());
      const double b = std::sqrt(1.2) * zeta, e = std::exp(-3.14159265358979324 * b / std::sqrt(1 - b * b));
      EXPECT_NEAR(s.packing.bodies.velocity[0][2], e, 3e-4);
    }
}

// Rolling round inside a shell without slip, no energy is lost or gained, and the spring stays tangential.
TEST(SphereWalls, CarryTheirSpringsRoundAShell) {
  State<Spheres> s;
  s.law = wall_law(NormalForce::hertz);
  s.law.damping = s.law.tangential_damping = 0, s.law.wall_friction = 10;
  const double lever = 0.4995;
  oracle::add_sphere(s.packing, 0.5, {{2.5005, 0, 0}}, {{0, 1, 0.2}}, {{0, 0.2 / lever, -1 / lever}});
  s.packing.walls = {shell(3)};
  s.time_step = 1e-5;
  Solver solver(s, {}, {});
  const auto energy = [&] {
    const Bodies<3>& b = s.packing.bodies;
    double sum = 0.5 * b.mass[0] * dot(b.velocity[0], b.velocity[0]) + 0.5 * b.inertia[0] * dot(b.spin[0], b.spin[0]);
    for (const WallLink& l : s.packing.wall_links) {
      const ContactStiffness c = wall_stiffness(s.law, b.radius[0]);
      sum += at_rest(s.law, c, l.gap).elastic + spring_energy(s.law, c, l.gap, l.tangential_force, {}).tangential;
      const Vec3 n = (-1 / norm(b.position[0])) * b.position[0];
      EXPECT_NEAR(dot(n, l.tangential_force), 0, 1e-10);
    }
    return sum;
  };
  solver.snapshot(s);
  const double begin = energy();
  for (int k = 0; k < 20; ++k) {
    solver.run(10000);
    solver.snapshot(s);
    EXPECT_LT(energy(), begin * (1 + 1e-5));
    EXPECT_GT(energy(), begin * 0.97);  // a spring that softens and hardens loses
  }
}

// A wall acts on its group alone, and one of every group on all.
TEST(SphereWalls, ActOnTheirGroup) {
  State<Spheres> s;
  s.law = wall_law(NormalForce::hertz);
  for (int g = 0; g < 2; ++g) oracle::add_sphere(s.packing, 0.5, {{2.0 * g, 0, 0.49}});
  s.packing.group = {0, 1};
  s.packing.walls = {floor()};
  s.packing.walls[0].group = 1;
  s.time_step = 1e-4;
  Solver one(s, {}, {});
  one.run(10);
  State<Spheres> after = s;
  one.snapshot(after);
  EXPECT_EQ(after.packing.bodies.velocity[0], Vec3{});
  EXPECT_GT(after.packing.bodies.velocity[1][2], 0);
  EXPECT_EQ(after.packing.group, s.packing.group);
  s.packing.walls[0].group = SphereWall::kEveryGroup;
  Solver all(s, {}, {});
  all.run(10);
  all.snapshot(after);
  EXPECT_EQ(after.packing.bodies.velocity[0], after.packing.bodies.velocity[1]);
}

// In the frame of a wall that moves all is as if it rested.
TEST(SphereWalls, MoveWithTheirVelocity) {
  State<Spheres> s;
  s.law = wall_law(NormalForce::hertz);
  oracle::add_sphere(s.packing, 0.5, {{0, 0, 0.52}}, {{0.5, 0, -1}}, {{1, 2, 3}});
  s.packing.walls = {floor()};
  s.time_step = 1e-4;
  State<Spheres> moving = s;
  const Vec3 u{{0.1, -0.3, 0.7}};
  moving.packing.walls[0].velocity = u, moving.packing.bodies.velocity[0] += u;
  Solver a(s, {}, {}), b(moving, {}, {});
  for (int k = 0; k < 30; ++k) {
    a.run(50), b.run(50);
    a.snapshot(s), b.snapshot(moving);
    EXPECT_NEAR(norm(moving.packing.bodies.velocity[0] - u - s.packing.bodies.velocity[0]), 0, 1e-9);
    EXPECT_NEAR(norm(moving.packing.bodies.spin[0] - s.packing.bodies.spin[0]), 0, 1e-8);
    EXPECT_NEAR(norm(moving.packing.walls[0].point - s.time * u), 0, 1e-12);
  }
}

TEST(SphereWalls, RefuseACellThatMoves) {
  State<Spheres> s;
  s.law = wall_law(NormalForce::hertz);
  for (int k = 0; k < 3; ++k) oracle::add_sphere(s.packing, 0.5, {{1.0 * k, 0, 1}});
  s.packing.cell = PeriodicCell<3>{{{5, 5, 5}}};
  s.cell_motion.reference_length = {{5, 5, 5}};
  s.packing.walls = {floor()};
  s.time_step = 1e-4;
  CellControl<3> control;
  control.strain_rate = {{0.1, 0, 0}};
  EXPECT_THROW(Solver(s, control, {}), InputError);
}

}  // namespace
}  // namespace isostat
