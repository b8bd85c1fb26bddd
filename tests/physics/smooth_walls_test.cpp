// Disks at smooth walls against closed forms, and the energy ledger in containers. m g = 1, T0 = sqrt(a / g).
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "analysis/link_network.hpp"
#include "analysis/stiffness/link_tangent.hpp"
#include "dem/disks/energy.hpp"
#include "dem/disks/engine.hpp"
#include "dem/disks/physical_hash.hpp"
#include "dem/disks/sample.hpp"
#include "dem/run/stages.hpp"
#include "dem/solver/random.hpp"
#include "dem/state/balance.hpp"

namespace isostat {
namespace {

constexpr double kStiffness = 1e4;

Scene scene_of(ContainerShape shape) {
  Scene scene;
  scene.grains.count = 1;
  scene.grains.diameter_min = 1;
  scene.grains.solid_fraction = shape == ContainerShape::drum ? 0.1 : 0.01;  // of the lower part: there one has room
  scene.law.attraction = 0, scene.law.normal_stiffness = kStiffness, scene.law.friction = 0.5,
  scene.law.rolling = false;
  scene.law.damping = 0.8;
  scene.step.fraction = 0.03;
  scene.gravity = 1;
  scene.container.shape = shape, scene.container.walls = ContainerWalls::smooth;
  scene.container.width = 40, scene.container.height = 10, scene.container.radius = 3;
  scene.stages.resize(1);
  return scene;
}

// One disk of radius 1/2, height above the floor.
State<Disks> one_disk(const Scene& scene, const Vec2& position, const Vec2& velocity = {}, double spin = 0) {
  State<Disks> s = initial_disks(scene, 1);
  EXPECT_EQ(s.packing.bodies.size(), 1u);
  s.packing.bodies.position[0] = position, s.packing.bodies.velocity[0] = velocity, s.packing.bodies.spin[0] = spin;
  s.progress.started = true;
  return s;
}

double march(State<Disks>& s, double time, bool energies = false) {
  SolverOptions options;
  options.energies = energies;
  Solver<Disks> solver(s, {}, options);
  solver.run(std::llround(time / s.time_step));
  solver.snapshot(s);
  return s.time;
}

TEST(SmoothWall, CarriesADiskAtItsStaticOverlap) {
  Scene scene = scene_of(ContainerShape::box);
  State<Disks> s = one_disk(scene, {{3, 0.6}});
  s.progress.started = false;
  const RunOutcome outcome = run_stages(s, {}, {});
  ASSERT_TRUE(outcome.all_met()) << outcome.stages.back().reason;
  ASSERT_EQ(s.packing.links.size(), 1u);
  const Link<2>& l = s.packing.links[0];
  EXPECT_NEAR(l.gap, -1 / kStiffness, 1e-4 / kStiffness);
  EXPECT_NEAR(l.normal_force, 1, 1e-4);
  EXPECT_EQ(l.tangential_force, 0);
  EXPECT_EQ(s.packing.bodies.position[0][0], 3);
  ASSERT_EQ(s.packing.feet.size(), 1u);
  EXPECT_EQ(s.packing.feet[0], (Foot{1, 0}));
  EXPECT_EQ(s.packing.bodies.position[1], (Vec2{{3, 0}}));
  EXPECT_EQ(s.packing.bodies.radius[1], 0);
  EXPECT_NEAR(net_loads(s.packing)[1].fy, -1, 1e-4);
}

// Contact with a wall: m_r = m. e = exp(-pi zeta / sqrt(1 - zeta^2)).
TEST(SmoothWall, ReturnsADiskWithTheRestitutionOfItsDamping) {
  for (const double zeta : {0.0, 0.2, 0.6}) {
    Scene scene = scene_of(ContainerShape::box);
    scene.gravity = 0, scene.law.damping = zeta, scene.law.friction = 0;
    State<Disks> s = one_disk(scene, {{0, 0.6}}, {{0.3, -1}});
    march(s, 0.4);
    const double e = std::exp(-std::numbers::pi * zeta / std::sqrt(1 - zeta * zeta));
    EXPECT_NEAR(s.packing.bodies.velocity[0][1], e, 2e-3) << zeta;
    EXPECT_NEAR(s.packing.bodies.velocity[0][0], 0.3, 1e-14);
    EXPECT_TRUE(s.packing.feet.empty());
  }
}

// Slides at -mu g until it rolls at 2/3 of its velocity, since I = m R^2/2, at the time v / (3 mu g).
TEST(SmoothWall, MakesASlidingDiskRoll) {
  const double v = 3, mu = 0.3, rolls_at = v / (3 * mu);
  Scene scene = scene_of(ContainerShape::box);
  scene.law.friction = mu;
  State<Disks> s = one_disk(scene, {{-15, 0.5 - 1 / kStiffness}}, {{v, 0}});
  const double half = march(s, 0.5 * rolls_at);
  EXPECT_NEAR(s.packing.bodies.velocity[0][0], v - mu * half, 1e-3);
  EXPECT_NEAR(s.packing.bodies.spin[0], -4 * mu * half, 1e-3);  // torque mu m g R over I
  EXPECT_EQ(s.packing.links.at(0).kind, LinkKind::sliding);
  march(s, rolls_at);
  EXPECT_NEAR(s.packing.bodies.velocity[0][0], 2 * v / 3, 2e-2);  // the spring swings
  march(s, 6);
  EXPECT_EQ(s.packing.links.at(0).kind, LinkKind::closed);
  const double speed = s.packing.bodies.velocity[0][0];
  EXPECT_NEAR(speed, 2 * v / 3, 2e-2);
  EXPECT_NEAR(s.packing.bodies.spin[0] * 0.5, -speed, 5e-2);
}

// Rolling resistance mu_r N at most: a wheel in a trough of depth mu_r, so that it is braked by 2/3 mu_r g / R.
TEST(SmoothWall, BrakesARollingDiskByItsRollingResistance) {
  const double v = 1, mu_r = 0.02;
  Scene scene = scene_of(ContainerShape::box);
  scene.law.rolling = true, scene.law.rolling_friction = mu_r, scene.law.rolling_stiffness = 100;
  State<Disks> s = one_disk(scene, {{-15, 0.5 - 1 / kStiffness}}, {{v, 0}}, -2 * v);
  const double t = march(s, 10);
  EXPECT_NEAR(s.packing.bodies.velocity[0][0], v - 2.0 / 3 * mu_r / 0.5 * t, 1e-2);
  march(s, 60);
  EXPECT_NEAR(s.packing.bodies.velocity[0][0], 0, 1e-2);
}

// At a side wall, N_e = F0: it hangs by friction, and does not roll down if mu_r F0 is more than its weight times R.
TEST(SmoothWall, HoldsACohesiveDisk) {
  Scene scene = scene_of(ContainerShape::box);
  scene.gravity = 0.9, scene.law.attraction = 1, scene.law.attraction_range = 1e-3, scene.law.friction = 2;
  scene.law.rolling = true, scene.law.rolling_friction = 0.6, scene.law.rolling_stiffness = 100;
  scene.finish.method = Finish::drag, scene.finish.quiet_time = 5;  // springs of friction are not damped
  scene.stages[0].max_time = 400;
  State<Disks> s = one_disk(scene, {{20 - 0.5 + 1 / kStiffness, 5}});
  s.progress.started = false;
  const RunOutcome outcome = run_stages(s, {}, {});
  ASSERT_TRUE(outcome.all_met()) << outcome.stages.back().reason;
  EXPECT_NEAR(s.packing.bodies.position[0][1], 5, 0.01);
  EXPECT_NEAR(std::abs(s.packing.links.at(0).tangential_force), 0.9, 1e-3);
  EXPECT_NEAR(std::abs(s.packing.links.at(0).moment), 0.45, 1e-3);
}

// In a turning drum a disk without rolling resistance rolls on the spot at the lowest point.
TEST(SmoothDrum, TurnsADiskAtTheBottom) {
  Scene scene = scene_of(ContainerShape::drum);
  scene.stages[0].container.rotation = 0.4;
  State<Disks> s = one_disk(scene, {{0, -2.5 - 1 / kStiffness}}, {}, 2.4);
  march(s, 200);
  const double from_axis = norm(s.packing.bodies.position[0]), lever = 3 - from_axis;
  EXPECT_NEAR(s.packing.bodies.spin[0], 0.4 * 3 / lever, 2e-2);
  EXPECT_NEAR(s.packing.bodies.position[0][0], 0, 5e-2);
  EXPECT_NEAR(s.packing.feet.at(0).turning, -1 / from_axis, 1e-12);
}

// In a corner and on the tip of a slope.
TEST(SmoothHopper, HasCornersAndAnEdge) {
  Scene scene = scene_of(ContainerShape::hopper);
  scene.container.opening = 3, scene.container.width = 10, scene.container.angle = 45;
  const std::vector<SmoothWall> walls = smooth_walls(scene.container, 1);
  ASSERT_EQ(walls.size(), 5u);
  const FootPoint slope = foot_point(walls[1], {{-2, 1.5}});  // line through (-1.5, 0), rising outwards
  EXPECT_NEAR(slope.place[0], -2.5, 1e-12);
  EXPECT_NEAR(slope.place[1], 1, 1e-12);
  EXPECT_EQ(slope.turning, 0);
  const FootPoint tip = foot_point(walls[1], {{-1.5, -0.4}});
  EXPECT_EQ(tip.place, (Vec2{{-1.5, 0}}));
  EXPECT_NEAR(tip.turning, 2.5, 1e-12);
  EXPECT_EQ(foot_point(walls[2], {{0.25, 0.5}}).place, (Vec2{{0.25, 0}}));
  EXPECT_EQ(walls[2].part, GrainPart::lid);
  // Behind the knee the upright wall goes on: nothing turns there.
  EXPECT_EQ(foot_point(walls[0], {{-4.6, 3.4}}).turning, 0);
}

TEST(SmoothHopper, RunsEmpty) {
  Scene scene = scene_of(ContainerShape::hopper);
  scene.grains.count = 30, scene.grains.diameter_min = 0.7, scene.grains.solid_fraction = 0.4;
  scene.container.width = 8, scene.container.opening = 4;
  scene.step.fraction = 0.1;
  scene.stages.resize(2);
  scene.stages[0].until = Until::time, scene.stages[0].time = 20;
  scene.stages[1].until = Until::empty, scene.stages[1].container.open = true, scene.stages[1].container.clog_time = 20;
  State<Disks> s = initial_disks(scene, 2);
  RunHooks<Disks> hooks;
  const RunOutcome outcome = run_stages(s, {}, hooks);
  ASSERT_TRUE(outcome.all_met()) << outcome.stages.back().reason;
  EXPECT_TRUE(s.packing.feet.empty());
  while (s.packing.bodies.size() > 0) {  // and on, to the last one
    s.progress = {}, s.progress.stage = 1;
    s.scene.stages[1].until = Until::time, s.scene.stages[1].time = 5;
    run_stages(s, {}, hooks);
  }
  EXPECT_EQ(s.surroundings.grains_left, 30);
}

// The tangent is the derivative of the solver's force, prestress included: on a line, at its end, in a drum.
TEST(SmoothWall, HasTheTangentOfItsForces) {
  struct Place {
    ContainerShape shape;
    Vec2 at;
  };
  for (const Place& place : {Place{ContainerShape::box, {{2, 0.48}}}, Place{ContainerShape::drum, {{1.7, -1.88}}},
                             Place{ContainerShape::hopper, {{-1.3, -0.44}}}}) {
    Scene scene = scene_of(place.shape);
    scene.gravity = 0, scene.law.friction = 0, scene.law.damping = 0;
    scene.container.opening = 3;
    const auto force = [&](const Vec2& r) {
      State<Disks> s = one_disk(scene, r);
      s.surroundings.open = true;
      Solver<Disks>(s, {}).snapshot(s);
      return s;
    };
    const State<Disks> s = force(place.at);
    ASSERT_EQ(s.packing.links.size(), 1u);
    const LinkTangent t = link_tangents(LinkNetwork(s.packing), NetworkLaw::frictionless, s.law).at(0);
    constexpr double kMove = 1e-6;
    for (int d = 0; d < 2; ++d) {
      Vec2 more = place.at, less = place.at;
      more[d] += kMove, less[d] -= kMove;
      const Vec2 change = (0.5 / kMove) * (force(more).memory.force[0] - force(less).memory.force[0]);
      const std::array<double, 6> r = LinkTangent::resistance(t.to_dof(d));
      EXPECT_NEAR(-change[0], r[0], 1e-5 * kStiffness) << static_cast<int>(place.shape) << d;
      EXPECT_NEAR(-change[1], r[1], 1e-5 * kStiffness) << static_cast<int>(place.shape) << d;
    }
  }
}

// ---- energies ----

struct Bed {
  const char* name;
  ContainerShape shape = ContainerShape::box;
  ContainerWalls walls = ContainerWalls::smooth;
  double damping = 0.5, amplitude = 0, rotation = 0, drag = 0;
};
// Largest error of the total over the run, in units of the largest kinetic energy.
double ledger_error(const Bed& bed, double step_fraction) {
  Scene scene = scene_of(bed.shape);
  scene.grains.count = 30, scene.grains.diameter_min = 0.7, scene.grains.solid_fraction = 0.3;
  scene.law.damping = bed.damping, scene.law.rolling = true;
  scene.container.walls = bed.walls, scene.container.width = 6, scene.container.wall_size = 0.5;
  scene.container.radius = 5;
  scene.step.fraction = step_fraction;
  scene.stages[0].container.vibration_amplitude = bed.amplitude, scene.stages[0].container.vibration_frequency = 0.4;
  scene.stages[0].container.rotation = bed.rotation;
  State<Disks> s = initial_disks(scene, 4);
  s.progress.started = true;
  SolverOptions options;
  options.energies = true;
  Solver<Disks> solver(s, {}, options);
  solver.set_drag(bed.drag);
  solver.snapshot(s);
  const double initial = energies(s).total();
  double worst = 0, kinetic = 0;
  for (int k = 0; k < 40; ++k) {
    solver.run(std::llround(0.2 / s.time_step));
    solver.snapshot(s);
    const Energies e = energies(s);
    worst = std::max(worst, std::abs(e.total() - initial)), kinetic = std::max(kinetic, e.kinetic);
  }
  const Energies e = energies(s);
  EXPECT_EQ(std::abs(e.ledger.wall_work) > 0.1 * kinetic, bed.amplitude > 0 || bed.rotation > 0);
  EXPECT_EQ(e.ledger.viscous > 0, bed.damping > 0);
  EXPECT_GT(std::abs(e.ledger.sliding), 0.01 * kinetic);
  EXPECT_EQ(e.ledger.drag > 0, bed.drag > 0);
  return worst / kinetic;
}

TEST(EnergyLedgerInAContainer, ClosesToTheErrorOfTheSteps) {
  for (const ContainerWalls walls : {ContainerWalls::smooth, ContainerWalls::grains})
    for (const Bed& bed :
         {Bed{"bed without damping", ContainerShape::box, walls, 0}, Bed{"bed", ContainerShape::box, walls},
          Bed{"shaken", ContainerShape::box, walls, 0.5, 0.3}, Bed{"drum", ContainerShape::drum, walls, 0.5, 0, 0.6},
          Bed{"shaken, with drag", ContainerShape::box, walls, 0.5, 0.3, 0, 0.3}}) {
      SCOPED_TRACE(std::string(bed.name) + (walls == ContainerWalls::smooth ? ", smooth" : ", grains"));
      const double standard = ledger_error(bed, 0.06), fine = ledger_error(bed, 0.03);
      RecordProperty("error_at_.06_.03", std::to_string(standard) + " " + std::to_string(fine));
      EXPECT_LT(standard, 1e-3);
      EXPECT_LT(fine, 3e-4);
      EXPECT_LT(fine, std::max(0.8 * standard, 3e-5));
    }
}

}  // namespace
}  // namespace isostat
