// Disks in containers: weight, walls that move as prescribed, and what leaves a hopper.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "dem/disks/certificate.hpp"
#include "dem/disks/check.hpp"
#include "dem/disks/container.hpp"
#include "dem/disks/engine.hpp"
#include "dem/disks/outflow.hpp"
#include "dem/disks/physical_hash.hpp"
#include "dem/disks/sample.hpp"
#include "dem/disks/series.hpp"
#include "dem/disks/state_check.hpp"
#include "dem/files/state_file.hpp"
#include "dem/input_error.hpp"
#include "dem/run/stages.hpp"
#include "dem/state/balance.hpp"
#include "dem/state/container_motion.hpp"
#include "dem/state/container_region.hpp"
#include "tests/support/temporary_folder.hpp"

namespace isostat {
namespace {

// Cohesionless; m g = 1 and T0 = sqrt(a / g).
Scene scene_of(ContainerShape shape, int grains) {
  Scene scene;
  scene.grains.count = grains;
  scene.grains.solid_fraction = 0.4;
  scene.grains.diameter_min = 0.7;
  scene.law.attraction = 0;
  scene.law.normal_stiffness = 1e4;
  scene.step.fraction = 0.1;
  scene.gravity = 1;
  scene.container.shape = shape;
  scene.container.wall_size = 0.5;
  if (shape == ContainerShape::drum)  // keys that do not apply are not kept
    scene.container.radius = 5;
  else
    scene.container.width = 8, scene.container.height = 10;
  if (shape == ContainerShape::hopper) scene.container.opening = 3;
  return scene;
}

StageScene timed(double time) {
  StageScene stage;
  stage.until = Until::time, stage.time = time;
  return stage;
}
StageScene outflow(Until until) {
  StageScene stage;
  stage.until = until, stage.max_time = 400;
  stage.container.open = true, stage.container.clog_time = 10;
  return stage;
}

std::size_t count(const State<Disks>& s, GrainPart part) {
  return static_cast<std::size_t>(std::count(s.packing.part.begin(), s.packing.part.end(), part));
}

TEST(WallDisks, LeaveTheRoomFreeAndHaveNoHoles) {
  for (const ContainerShape shape : {ContainerShape::box, ContainerShape::hopper, ContainerShape::drum}) {
    const ContainerScene c = scene_of(shape, 10).container;
    const std::vector<WallDisk> walls = wall_disks(c);
    double narrowest = INFINITY;
    for (const WallDisk& w : walls) {
      double nearest = INFINITY;  // of the other disks
      for (const WallDisk& other : walls)
        if (&other != &w) nearest = std::min(nearest, norm(other.position - w.position));
      EXPECT_LE(nearest, c.wall_size * (1 + 1e-9));
      EXPECT_FALSE(holds(c, w.position, 0)) << w.position[0] << " " << w.position[1];
      if (w.part == GrainPart::wall) narrowest = std::min(narrowest, std::abs(w.position[0]) - c.wall_size / 2);
    }
    const auto lids =
        std::count_if(walls.begin(), walls.end(), [](const WallDisk& w) { return w.part == GrainPart::lid; });
    EXPECT_EQ(lids > 0, shape == ContainerShape::hopper);
    if (shape == ContainerShape::hopper) {
      EXPECT_NEAR(narrowest, c.opening / 2, 1e-12);
    }
  }
}

TEST(Weight, AFreeGrainFallsAsLeapfrogSays) {
  Scene scene = scene_of(ContainerShape::box, 1);
  scene.container.height = 100;
  scene.stages = {timed(1)};
  State<Disks> s = initial_disks(scene, 1);
  const auto grain = static_cast<std::size_t>(std::find(s.packing.bodies.id.begin(), s.packing.bodies.id.end(), 0) -
                                              s.packing.bodies.id.begin());
  s.packing.bodies.position[grain] = {{0, 50}};
  run_stages(s, {}, {});
  const auto now = static_cast<std::size_t>(std::find(s.packing.bodies.id.begin(), s.packing.bodies.id.end(), 0) -
                                            s.packing.bodies.id.begin());
  EXPECT_NEAR(s.packing.bodies.position[now][1], 50 - 0.5 * s.time * s.time, 1e-11);
  EXPECT_NEAR(s.packing.bodies.velocity[now][1], -s.time, 1e-11);
  EXPECT_NEAR(s.certificate.max_force, 1, 1e-12);  // its weight, with nothing to carry it
  EXPECT_FALSE(s.certificate.equilibrated);
}

TEST(Weight, ABedComesToRestOnItsFloor) {
  Scene scene = scene_of(ContainerShape::box, 40);
  StageScene settle;
  settle.max_time = 2000;
  scene.finish.method = Finish::drag, scene.finish.quiet_time = 5;
  scene.stages = {settle};
  State<Disks> s = initial_disks(scene, 3);
  const RunOutcome outcome = run_stages(s, {}, {});
  ASSERT_TRUE(outcome.all_met()) << outcome.stages.back().reason;
  EXPECT_TRUE(s.certificate.equilibrated);
  EXPECT_FALSE(s.certificate.pressure_controlled);
  EXPECT_LE(s.certificate.force_scale, 1);
  double weight = 0, carried = 0;
  const std::vector<BodyLoad> loads = net_loads(s.packing);
  for (std::size_t k = 0; k < loads.size(); ++k)
    (is_free(s.packing.part, k) ? weight : carried) +=
        is_free(s.packing.part, k) ? s.packing.bodies.mass[k] : -loads[k].fy;
  EXPECT_NEAR(carried, weight, 40 * 1e-4);
  for (std::size_t k = 0; k < loads.size(); ++k)
    if (!is_free(s.packing.part, k)) {
      EXPECT_EQ(s.packing.bodies.velocity[k], Vec2{});
    }
  const Certificate again = evaluate_certificate(s);
  EXPECT_EQ(again.max_force, s.certificate.max_force);
}

// Every wall disk is where the container is, at every look, in storage order.
void expect_walls_in_place(const State<Disks>& s, std::size_t walls) {
  const ContainerPlacement at = container_of(s);
  std::size_t seen = 0;
  for (std::size_t k = 0; k < s.packing.part.size(); ++k) {
    if (is_free(s.packing.part, k)) continue;
    const Vec2 r = point_at(at, s.memory.wall_position[seen++]);
    const Vec2 v = velocity_at(at, r);
    for (int a = 0; a < 2; ++a) {
      EXPECT_EQ(s.packing.bodies.position[k][a], r[a]);
      EXPECT_EQ(s.packing.bodies.velocity[k][a], v[a]);
    }
    EXPECT_EQ(s.packing.bodies.spin[k], at.spin);
  }
  EXPECT_EQ(seen, walls);
}

TEST(DrivenWalls, FollowTheirContainerThroughAllStages) {
  Scene scene = scene_of(ContainerShape::drum, 50);
  StageScene turn = timed(4), shake = timed(2.3);
  turn.container.rotation = 0.2;
  shake.container.vibration_amplitude = 0.1, shake.container.vibration_frequency = 0.7;
  scene.stages = {turn, shake, turn};
  State<Disks> s = initial_disks(scene, 3);
  const std::size_t walls = count(s, GrainPart::wall);
  int looks = 0;
  RunHooks<Disks> hooks;
  hooks.observe_interval = 0.37;
  hooks.observe = [&](const State<Disks>& now) {
    expect_walls_in_place(now, walls);
    ++looks;
  };
  const RunOutcome outcome = run_stages(s, {}, hooks);
  ASSERT_TRUE(outcome.all_met());
  EXPECT_GT(looks, 20);
  const double first = scene.stages[0].time, whole = s.surroundings.start_angle;
  EXPECT_NEAR(whole, 2 * first * 0.2, 0.01);
  EXPECT_NEAR(s.surroundings.start_offset[1], 0.1 * (std::cos(2 * std::numbers::pi * 0.7 * 2.3) - 1), 0.01);
  EXPECT_EQ(s.surroundings.start_offset[0], 0);
}

// Its wall of disks grips: the bed is carried up on the side that rises until it is inclined.
TEST(DrivenWalls, ADrumOfDisksGripsItsBed) {
  Scene scene = scene_of(ContainerShape::drum, 50);
  StageScene turn = timed(30);
  turn.container.rotation = 0.05;
  scene.stages = {timed(40), turn};
  scene.output.stages = true;
  State<Disks> s = initial_disks(scene, 5);
  const auto value = [](const State<Disks>& state, std::string_view name) {
    for (const SeriesColumn& c : series_columns(state, false))
      if (c.name == name) return c.value;
    return std::nan("");
  };
  double before = NAN;
  RunHooks<Disks> hooks;
  hooks.stage_end = [&](const State<Disks>& now) {
    if (std::isnan(before)) before = value(now, "inclination_mass");
  };
  run_stages(s, {}, hooks);
  EXPECT_LT(std::abs(before), 15);
  EXPECT_GT(value(s, "inclination_mass"), 10);
  EXPECT_NEAR(value(s, "angle"), 30 * 0.05 * 180 / std::numbers::pi, 0.5);
}

TEST(Hopper, KeepsItsGrainsUntilItIsOpened) {
  Scene scene = scene_of(ContainerShape::hopper, 60);
  scene.container.opening = 5;
  scene.stages = {timed(20), outflow(Until::empty)};
  State<Disks> s = initial_disks(scene, 2);
  const std::size_t lids = count(s, GrainPart::lid), walls = count(s, GrainPart::wall);
  EXPECT_GT(lids, 2u);
  double mass = 0;
  for (std::size_t k = 0; k < s.packing.bodies.size(); ++k)
    if (is_free(s.packing.part, k)) mass += s.packing.bodies.mass[k];
  bool closed = true;
  RunHooks<Disks> hooks;
  hooks.stage_end = [&](const State<Disks>& now) {
    if (!closed) return;
    closed = false;
    EXPECT_FALSE(now.surroundings.open);
    EXPECT_EQ(grains_above_outlet(now), 60);
    EXPECT_EQ(count(now, GrainPart::lid), lids);
  };
  hooks.progress = [&](const Progress&) {
    EXPECT_EQ(count_free(s.packing) + static_cast<std::size_t>(s.surroundings.grains_left), 60u);
  };
  const RunOutcome outcome = run_stages(s, {}, hooks);
  ASSERT_TRUE(outcome.all_met()) << outcome.stages.back().reason;
  EXPECT_TRUE(s.surroundings.open);
  EXPECT_EQ(count(s, GrainPart::lid), 0u);
  EXPECT_EQ(count(s, GrainPart::wall), walls);
  EXPECT_EQ(s.memory.wall_position.size(), walls);
  EXPECT_EQ(grains_above_outlet(s), 0);
  EXPECT_GT(s.surroundings.grains_left, 40);
  double still = 0;
  for (std::size_t k = 0; k < s.packing.bodies.size(); ++k)
    if (is_free(s.packing.part, k)) still += s.packing.bodies.mass[k];
  EXPECT_NEAR(s.surroundings.mass_left + still, mass, 1e-12);
}

// A narrow outlet and friction. The stage that waits for the other end says which one came.
TEST(Hopper, ClogsOrEmpties) {
  Scene scene = scene_of(ContainerShape::hopper, 60);
  scene.container.opening = 1.3;
  scene.law.friction = 0.8;
  scene.stages = {timed(20), outflow(Until::clogged)};
  State<Disks> s = initial_disks(scene, 2);
  const RunOutcome clogs = run_stages(s, {}, {});
  ASSERT_TRUE(clogs.all_met()) << clogs.stages.back().reason;
  const std::int64_t left = grains_above_outlet(s);
  EXPECT_GT(left, 0);
  EXPECT_GE(s.time - std::max(s.surroundings.last_left, s.progress.start_time), 10);

  scene.stages[1] = outflow(Until::empty);
  s = initial_disks(scene, 2);
  const RunOutcome stuck = run_stages(s, {}, {});
  EXPECT_FALSE(stuck.all_met());
  EXPECT_EQ(stuck.stages.back().reason, "clogged: " + std::to_string(left) + " grains left");

  scene.container.opening = 4;
  scene.stages[1] = outflow(Until::clogged);
  s = initial_disks(scene, 2);
  const RunOutcome ran_out = run_stages(s, {}, {});
  EXPECT_FALSE(ran_out.all_met());
  EXPECT_EQ(ran_out.stages.back().reason.substr(0, 5), "empty");
}

// The lids are gone, grains are taken away, the hopper shakes: a run that is interrupted again and again, at looks and
// between them, ends as the straight one does; so does one of two threads.
TEST(Hopper, AnInterruptedRunGoesOnAsIfItHadNotBeen) {
  Scene scene = scene_of(ContainerShape::hopper, 60);
  StageScene open = timed(4);
  open.container = outflow(Until::empty).container;
  open.container.vibration_amplitude = 0.05, open.container.vibration_frequency = 0.9;
  scene.stages = {timed(8), open, timed(3)};
  State<Disks> straight = initial_disks(scene, 6);
  ASSERT_TRUE(run_stages(straight, {}, {}).all_met());
  EXPECT_GT(straight.surroundings.grains_left, 10);
  EXPECT_LT(straight.surroundings.grains_left, 60);

  const TemporaryFolder folder;
  const std::string path = folder / "state.h5";
  State<Disks> s = initial_disks(scene, 6);
  int interruptions = 0;
  for (bool done = false; !done && interruptions < 1000; interruptions += !done) {
    int polls = 0;
    RunHooks<Disks> hooks;
    hooks.interrupted = [&] { return ++polls > 5; };
    hooks.observe = [](const State<Disks>&) {};
    hooks.observe_interval = 0.0937;  // stops at odd steps
    done = !run_stages(s, {}, hooks).interrupted;
    write_state(s, path);
    s = read_state<Disks>(path);
  }
  EXPECT_GT(interruptions, 20);
  EXPECT_EQ(physical_hash(s), physical_hash(straight));
  EXPECT_EQ(s.surroundings, straight.surroundings);

  State<Disks> shared = initial_disks(scene, 6);
  SolverOptions two;
  two.threads = 2;
  run_stages(shared, two, {});
  EXPECT_EQ(physical_hash(shared), physical_hash(straight));
}

TEST(StateOfAContainer, WithAWrongListOfWallsIsRefused) {
  Scene scene = scene_of(ContainerShape::box, 10);
  scene.stages = {timed(1)};
  State<Disks> s = initial_disks(scene, 1);
  run_stages(s, {}, {});
  ASSERT_FALSE(state_fault(s));
  const std::string hash = physical_hash(s);
  State<Disks> bad = s;
  bad.packing.part.pop_back();
  EXPECT_EQ(state_fault(bad)->field, "particles/grains/part");
  bad = s;
  bad.packing.part[0] = static_cast<GrainPart>(3);
  EXPECT_EQ(state_fault(bad)->field, "particles/grains/part");
  bad = s;
  bad.memory.wall_position.pop_back();
  EXPECT_EQ(state_fault(bad)->field, "solver/wall_position");
  bad = s;
  bad.packing.part[0] = bad.packing.part[0] == GrainPart::free ? GrainPart::wall : GrainPart::free;
  EXPECT_NE(physical_hash(bad), hash);
}

TEST(RemoveBodies, KeepsOrderAndRenumbers) {
  State<Disks> s;
  s.packing.bodies.resize(4);
  s.packing.bodies.id = {10, 11, 12, 13};
  s.packing.part = {GrainPart::free, GrainPart::wall, GrainPart::free, GrainPart::lid};
  s.memory.wall_position = {{{1, 1}}, {{2, 2}}};
  s.memory.half_spin = {0, 1, 2, 3};
  s.packing.links.resize(2);
  s.packing.links[0].i = 0, s.packing.links[0].j = 2;
  s.packing.links[1].i = 2, s.packing.links[1].j = 3;
  s.memory.pairs = {{0, 2, {}, {5, 0}}, {1, 2, {}, {6, 0}}};
  remove_bodies(s, {0, 1, 0, 0});
  EXPECT_EQ(s.packing.bodies.id, (std::vector<std::int64_t>{10, 12, 13}));
  EXPECT_EQ(s.memory.half_spin, (std::vector<double>{0, 2, 3}));
  EXPECT_EQ(s.memory.wall_position, (std::vector<Vec2>{{{2, 2}}}));
  ASSERT_EQ(s.packing.links.size(), 2u);
  EXPECT_EQ(s.packing.links[1].i, 1);
  EXPECT_EQ(s.packing.links[1].j, 2);
  ASSERT_EQ(s.memory.pairs.size(), 1u);
  EXPECT_EQ(s.memory.pairs[0].j, 1);
  EXPECT_TRUE(s.memory.force.empty());
}

TEST(ContainerOfDisks, RefusesWhatDisksCannotDo) {
  Scene scene = scene_of(ContainerShape::hopper, 60);
  scene.stages = {outflow(Until::empty)};
  const auto refused = [](const Scene& s) {
    std::string keys;
    for (const SceneConflict& c : disk_conflicts(s)) keys += c.key + " ";
    return keys;
  };
  EXPECT_EQ(refused(scene), "");
  Scene bad = scene;
  bad.finish.method = Finish::newton;
  EXPECT_EQ(refused(bad), "finish.method ");
  bad = scene, bad.law.normal_stiffness = 60;  // enough for a grain alone, not for those at the bottom
  EXPECT_EQ(refused(bad), "law.normal_stiffness ");
  bad = scene, bad.stages[0].container.vibration_amplitude = 0.1, bad.stages[0].container.vibration_frequency = 60;
  EXPECT_EQ(refused(bad), "stage.0.vibration_frequency ");
}

// Grains that rest in a hopper are started from, walls and all; a bare packing gets the container of its scene.
TEST(ContainerOfDisks, StartsFromAFile) {
  Scene scene = scene_of(ContainerShape::hopper, 30);
  scene.container.opening = 5;
  scene.stages = {timed(15)};
  scene.stages[0].container.vibration_amplitude = 0.1, scene.stages[0].container.vibration_frequency = 0.37;
  State<Disks> filled = initial_disks(scene, 1);
  run_stages(filled, {}, {});
  const TemporaryFolder folder;
  const std::string path = folder / "filled.h5";
  write_state(filled, path);
  Scene flow = scene;
  flow.grains.file = path;
  flow.stages = {outflow(Until::empty)};
  State<Disks> s = initial_disks(flow, 1);
  EXPECT_EQ(s.surroundings.start_offset[1], filled.surroundings.start_offset[1]);
  EXPECT_NE(s.surroundings.start_offset[1], 0);
  EXPECT_EQ(count(s, GrainPart::wall), count(filled, GrainPart::wall));
  EXPECT_GT(count(s, GrainPart::lid), 0u);
  const RunOutcome outcome = run_stages(s, {}, {});
  EXPECT_TRUE(outcome.all_met()) << outcome.stages.back().reason;

  flow.container.opening = 4;
  EXPECT_THROW(initial_disks(flow, 1), InputError);
}

TEST(ContainerOfDisks, IsRefusedWhereTheGrainsHaveNoRoom) {
  Scene scene = scene_of(ContainerShape::drum, 200);
  EXPECT_THROW(initial_disks(scene, 1), InputError);
}

}  // namespace
}  // namespace isostat
