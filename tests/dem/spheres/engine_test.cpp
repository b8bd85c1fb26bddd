// Spheres in numbers: conserved quantities, threads, restarts, lists, free cells, interference.
#include "dem/spheres/engine.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/sphere_states.hpp"

namespace isostat {
namespace {

using oracle::RandomSpheres;

State<Spheres> marched(const State<Spheres>& start, std::int64_t steps, const CellControl<3>& control = {},
                       SolverOptions options = {}) {
  Solver solver(start, control, options);
  solver.run(steps);
  State<Spheres> end = start;
  solver.snapshot(end);
  return end;
}

// The same bits, storage order included.
void expect_same(const State<Spheres>& a, const State<Spheres>& b) {
  EXPECT_EQ(a.packing.bodies.id, b.packing.bodies.id);
  EXPECT_EQ(a.packing.bodies.position, b.packing.bodies.position);
  EXPECT_EQ(a.packing.bodies.velocity, b.packing.bodies.velocity);
  EXPECT_EQ(a.packing.bodies.spin, b.packing.bodies.spin);
  EXPECT_EQ(a.packing.group, b.packing.group);
  EXPECT_EQ(a.packing.walls, b.packing.walls);
  EXPECT_EQ(a.packing.cell.has_value(), b.packing.cell.has_value());
  if (a.packing.cell) {
    EXPECT_EQ(a.packing.cell->length, b.packing.cell->length);
  }
  EXPECT_EQ(a.memory.half_velocity, b.memory.half_velocity);
  EXPECT_EQ(a.memory.half_spin, b.memory.half_spin);
  EXPECT_EQ(a.memory.force, b.memory.force);
  EXPECT_EQ(a.memory.torque, b.memory.torque);
  EXPECT_EQ(a.cell_motion.stress, b.cell_motion.stress);
  ASSERT_EQ(a.memory.pairs.size(), b.memory.pairs.size());
  for (std::size_t k = 0; k < a.memory.pairs.size(); ++k)
    EXPECT_EQ(a.memory.pairs[k].history, b.memory.pairs[k].history);
  ASSERT_EQ(a.memory.wall_springs.size(), b.memory.wall_springs.size());
  for (std::size_t k = 0; k < a.memory.wall_springs.size(); ++k)
    EXPECT_EQ(a.memory.wall_springs[k].tangential_force, b.memory.wall_springs[k].tangential_force);
}

CellControl<3> squeezing() {
  CellControl<3> control;
  control.stress = isotropic<3>(50);
  control.max_strain_rate = 1, control.inertia = 10;
  return control;
}

// In a shell, with a floor below that pushes.
State<Spheres> in_walls(int count) {
  RandomSpheres r;
  r.count = count, r.cell = false, r.room = 0.6;
  State<Spheres> s = random_state(r);
  const double side = std::cbrt(r.room * count);
  SphereWall shell;
  shell.shape = WallShape::shell, shell.point = {{side / 2, side / 2, side / 2}},
  shell.radius = std::sqrt(0.75) * side * (1 - 1 / std::ceil(std::cbrt(count))) + 0.3;
  shell.group = 0;
  SphereWall floor;
  floor.normal = {{0, 0, 1}}, floor.velocity = {{0, 0, 0.3}};
  s.packing.walls = {shell, floor};
  s.packing.group.assign(s.packing.bodies.size(), 0);
  for (std::size_t k = 1; k < s.packing.group.size(); k += 3) s.packing.group[k] = 1;
  s.scene.gravity = 1;
  return s;
}

TEST(SphereEngine, ConservesMomentumAndAngularMomentum) {
  for (const SphereLaw& law : oracle::sphere_laws()) {
    SCOPED_TRACE(oracle::words(law));
    RandomSpheres r;
    r.law = law, r.cell = false, r.room = 0.4, r.time_step = 5e-4;
    State<Spheres> s = random_state(r);
    const auto momenta = [](const State<Spheres>& at) {
      const Bodies<3>& b = at.packing.bodies;
      Vec3 p{}, l{};
      for (std::size_t k = 0; k < b.size(); ++k) {
        p += b.mass[k] * b.velocity[k];
        l += b.mass[k] * cross(b.position[k], b.velocity[k]) + b.inertia[k] * b.spin[k];
      }
      return std::array{p, l};
    };
    Solver solver(s, {}, {});
    solver.snapshot(s);
    const auto begin = momenta(s);
    EXPECT_FALSE(s.packing.links.empty());
    solver.run(500);
    solver.snapshot(s);
    const auto end = momenta(s);
    EXPECT_GT(solver.engine().lists().inner_rebuilds(), 3u);
    EXPECT_LT(norm(end[0] - begin[0]), 1e-11);
    EXPECT_LT(norm(end[1] - begin[1]), 1e-10);
  }
}

TEST(SphereEngine, HasTheSameBitsForAnyNumberOfThreads) {
  RandomSpheres r;
  r.count = 9000, r.room = 0.5;
  State<Spheres> walled = in_walls(9000);
  ASSERT_GT(SphereEngine::Lists::chunk_count(9000), 1);
  const State<Spheres> one = marched(random_state(r), 40, squeezing()), one_walled = marched(walled, 40);
  EXPECT_FALSE(one_walled.packing.wall_links.empty());
  for (const int threads : {2, 3}) {
    SolverOptions options;
    options.threads = threads;
    expect_same(marched(random_state(r), 40, squeezing(), options), one);
    expect_same(marched(walled, 40, {}, options), one_walled);
  }
}

TEST(SphereEngine, RestartsAsIfItHadRunStraight) {
  for (const SphereLaw& law : oracle::sphere_laws())
    for (const char* around : {"fixed cell", "free cell", "no cell", "walls"}) {
      const std::string room(around);
      SCOPED_TRACE(oracle::words(law) + ", " + room);
      RandomSpheres r;
      r.law = law, r.room = 0.45;
      State<Spheres> s = room == "walls" ? in_walls(60) : random_state(r);
      s.law = law;
      if (room == "no cell") s.packing.cell.reset(), s.cell_motion = {};
      const CellControl<3> control = room == "free cell" ? squeezing() : CellControl<3>{};
      const State<Spheres> end = marched(s, 150, control);
      EXPECT_FALSE(end.packing.links.empty());
      for (const std::int64_t cut : {1, 37, 149})
        expect_same(marched(marched(s, cut, control), 150 - cut, control), end);
    }
}

// Lists show every pair that interacts: forces as from all pairs and images.
TEST(SphereEngine, MissesNoPair) {
  RandomSpheres r;
  r.count = 200, r.radius_min = 0.05, r.room = 0.3, r.speed = 3, r.time_step = 2e-4;
  State<Spheres> s = random_state(r);
  Solver solver(s, {}, {});
  for (int look = 0; look < 10; ++look) {
    solver.run(50);
    solver.snapshot(s);
    const Bodies<3>& b = s.packing.bodies;
    std::size_t interacting = 0;
    for (std::size_t i = 0; i < b.size(); ++i)
      for (std::size_t j = i + 1; j < b.size(); ++j)
        for (std::uint8_t code = 0; code < 27; ++code) {
          const Vec3 d = b.position[j] + s.packing.cell->offset(image_shift<3>(code)) - b.position[i];
          interacting += norm(d) - b.radius[i] - b.radius[j] < s.law.attraction_range;
        }
    EXPECT_EQ(s.packing.links.size(), interacting);
  }
}

// A frictionless scene turns nothing; without spin it is the scene with friction where nothing slips.
TEST(SphereEngine, FrictionlessSpheresKeepTheirSpins) {
  RandomSpheres r;
  r.law.friction = r.law.wall_friction = r.law.rolling_friction = r.law.rolling_stiffness = 0, r.room = 0.4;
  State<Spheres> s = random_state(r);
  const State<Spheres> end = marched(s, 100);
  for (std::size_t k = 0; k < end.packing.bodies.size(); ++k)
    EXPECT_EQ(end.packing.bodies.spin[k],
              s.packing.bodies.spin[static_cast<std::size_t>(end.packing.bodies.id[k] - 1)]);
}

// The measured stress is that of links and velocities.
TEST(SphereEngine, MeasuresTheStressOfItsLinks) {
  RandomSpheres r;
  r.law.damping = r.law.tangential_damping = 0, r.room = 0.4;
  const State<Spheres> s = marched(random_state(r), 60, squeezing());
  Vec3 sum{};
  const Bodies<3>& b = s.packing.bodies;
  for (const Link<3>& l : s.packing.links) {
    const Vec3 d = b.position[static_cast<std::size_t>(l.j)] + s.packing.cell->offset(l.shift) -
                   b.position[static_cast<std::size_t>(l.i)];
    const Vec3 f = (l.normal_force / norm(d)) * d + l.tangential_force;
    for (int a = 0; a < 3; ++a) sum[a] += f[a] * d[a];
  }
  const double volume = s.packing.cell->measure();
  double kinetic = 0;
  for (std::size_t k = 0; k < b.size(); ++k) kinetic += b.mass[k] * dot(b.velocity[k], b.velocity[k]) / 3;
  for (int a = 0; a < 3; ++a) {
    EXPECT_NEAR(s.cell_motion.stress[a], (sum[a] + kinetic) / volume, 0.2 * kinetic / volume);
    EXPECT_GT(std::abs(sum[a]), 2 * kinetic);
  }
}

// A group turned rigidly feels the turned forces; so do its walls.
TEST(SphereEngine, TurnsAGroupRigidly) {
  State<Spheres> s = in_walls(60);
  s.scene.gravity = 0;
  s.packing.walls.pop_back();  // the floor
  s.packing.group.clear();
  s = marched(s, 200);
  const Vec3 axis{{2.0 / 3, 1.0 / 3, 2.0 / 3}}, centre{{1, 2, 3}};
  const double angle = 0.7;
  const auto turned = [&](const Vec3& v) {
    return std::cos(angle) * v + std::sin(angle) * cross(axis, v) + ((1 - std::cos(angle)) * dot(axis, v)) * axis;
  };
  Solver plain(s, {}, {}), turning(s, {}, {});
  turning.engine().rotate(0, axis, angle, centre);
  const auto expect_turned = [&](double tolerance) {
    State<Spheres> a = s, b = s;
    plain.snapshot(a), turning.snapshot(b);
    std::vector<std::size_t> place(a.packing.bodies.size() + 1);
    for (std::size_t k = 0; k < b.packing.bodies.size(); ++k)
      place[static_cast<std::size_t>(b.packing.bodies.id[k])] = k;
    for (std::size_t k = 0; k < a.packing.bodies.size(); ++k) {
      const std::size_t at = place[static_cast<std::size_t>(a.packing.bodies.id[k])];
      EXPECT_LT(norm(centre + turned(a.packing.bodies.position[k] - centre) - b.packing.bodies.position[at]),
                tolerance);
      EXPECT_LT(norm(turned(a.memory.force[k]) - b.memory.force[at]), 1e3 * tolerance);
      EXPECT_LT(norm(turned(a.memory.torque[k]) - b.memory.torque[at]), 1e3 * tolerance);
    }
    EXPECT_LT(norm(turned(plain.engine().force_on_wall(0)) - turning.engine().force_on_wall(0)), 1e3 * tolerance);
    EXPECT_EQ(a.packing.links.size(), b.packing.links.size());
    EXPECT_FALSE(a.packing.wall_links.empty());
  };
  expect_turned(1e-12);
  plain.run(100), turning.run(100);
  expect_turned(1e-9);
}

TEST(SphereEngine, AnswersWithTheForcesOfTheInstant) {
  const State<Spheres> s = marched(in_walls(60), 20);
  Solver solver(s, {}, {});
  SphereEngine& engine = solver.engine();
  Vec3 expected{}, on_shell{};
  const Bodies<3>& b = s.packing.bodies;
  for (const Link<3>& l : s.packing.links) {
    const auto i = static_cast<std::size_t>(l.i), j = static_cast<std::size_t>(l.j);
    if (s.packing.group[i] == s.packing.group[j]) continue;
    const Vec3 d = b.position[j] - b.position[i], on_j = (l.normal_force / norm(d)) * d + l.tangential_force;
    expected += (s.packing.group[j] == 1 ? 1.0 : -1.0) * on_j;
  }
  for (const WallLink& l : s.packing.wall_links)
    if (l.wall == 0) {
      const Vec3 in = s.packing.walls[0].point - b.position[static_cast<std::size_t>(l.body)];
      on_shell -= (l.normal_force / norm(in)) * in + l.tangential_force;
    }
  EXPECT_GT(norm(expected), 0);
  EXPECT_GT(norm(on_shell), 0);
  EXPECT_LT(norm(engine.force_between(0, 1) - expected), 1e-12 * norm(expected));
  EXPECT_LT(norm(engine.force_between(1, 0) + expected), 1e-12 * norm(expected));
  EXPECT_LT(norm(engine.force_on_wall(0) - on_shell), 1e-12 * norm(on_shell));

  const Vec3 u{{1, 2, 3}};
  engine.boost(1, u);
  State<Spheres> boosted = s;
  solver.snapshot(boosted);
  for (std::size_t k = 0; k < b.size(); ++k)
    EXPECT_LT(norm(boosted.packing.bodies.velocity[k] - b.velocity[k] - (s.packing.group[k] == 1 ? u : Vec3{})), 1e-12);
  engine.stop();
  EXPECT_EQ(engine.relaxation().speed_squared, 0);
  engine.steer(0, 2);
  EXPECT_NEAR(engine.relaxation().power, 2 * engine.relaxation().pull_squared, 1e-9 * engine.relaxation().pull_squared);
}

// FIRE as a protocol would write it: damping off, springs carried, velocities steered along the forces.
TEST(SphereEngine, RelaxesByFire) {
  State<Spheres> s = in_walls(60);
  s.scene.gravity = 0;
  s.packing.walls.resize(1);
  s.packing.group.clear();
  s.law.attraction = s.law.attraction_range = 0;
  s.packing.walls[0].radius *= 0.75;
  s = marched(s, 300);
  SphereLaw undamped = s.law;
  undamped.damping = undamped.tangential_damping = 0;
  Solver solver(s, {}, {});
  SphereEngine& engine = solver.engine();
  engine.stop();
  engine.set_law(undamped, Springs::keep_forces);
  double mixing = 0.1;
  int uphill = 0;
  for (int k = 0; k < 4000; ++k) {
    solver.step();
    const SphereEngine::Relaxation r = engine.relaxation();
    if (r.power > 0) {
      engine.steer(1 - mixing, mixing * std::sqrt(r.speed_squared / r.pull_squared));
      mixing *= 0.99;
    } else {
      engine.stop();
      mixing = 0.1, ++uphill;
    }
  }
  const double residual = std::sqrt(engine.relaxation().force_squared / (2 * engine.squared_contact_forces()));
  EXPECT_LT(residual, 1e-4);
  EXPECT_GT(uphill, 0);
  EXPECT_GT(engine.squared_contact_forces(), 0);
}

}  // namespace
}  // namespace isostat
