// Determinism is a feature: the same bits for any number of threads, after any restart, watched or not.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "dem/files/state_file.hpp"
#include "dem/run/series.hpp"
#include "dem/run/stages.hpp"
#include "dem/state/physical_hash.hpp"
#include "tests/support/disk_states.hpp"
#include "tests/support/temporary_folder.hpp"

namespace isostat {
namespace {

using oracle::random_state;
using oracle::RandomDisks;
using oracle::soft_law;

CellControl barostat(const State& s, double pressure) {
  CellControl c;
  c.stress = isotropic(pressure), c.max_strain_rate = 2, c.inertia = 0.3 * oracle::total_mass(s);
  return c;
}

State marched(State s, const CellControl& control, std::int64_t steps, SolverOptions options = {}) {
  Solver solver(s, control, options);
  solver.run(steps);
  solver.snapshot(s);
  return s;
}

// Digest of everything in the state, memory included: of the state file's bytes.
std::size_t bytes(State s) {
  s.scene = {}, s.progress.stage = 0;  // keys that do not apply are not kept
  return std::hash<std::string>{}(encode_state(s));
}

TEST(Determinism, AnyNumberOfThreadsGivesTheSameBits) {
  RandomDisks r;
  r.count = 9000, r.law = soft_law(), r.solid_fraction = 0.48, r.squeeze = 0.95, r.speed = 3;
  const State start = random_state(r);
  ASSERT_GT(NeighbourLists::chunk_count(start.packing.bodies.size()), 1);
  const CellControl control = barostat(start, 60);
  std::vector<std::size_t> images;
  for (int threads : {1, 2, 3}) {
    SolverOptions options;
    options.threads = threads;
    images.push_back(bytes(marched(start, control, 60, options)));
  }
  EXPECT_EQ(images[1], images[0]);
  EXPECT_EQ(images[2], images[0]);
  EXPECT_NE(bytes(start), images[0]);
}

struct Composition {
  const char* name;
  bool adhesion, damping, friction, rolling, free_cell;
};
std::vector<Composition> compositions() {
  std::vector<Composition> list;
  for (bool adhesion : {false, true})
    for (bool free_cell : {false, true}) {
      list.push_back({"frictionless", adhesion, true, false, false, free_cell});
      list.push_back({"friction", adhesion, true, true, false, free_cell});
      list.push_back({"rolling", adhesion, true, true, true, free_cell});
      list.push_back({"undamped rolling", adhesion, false, true, true, free_cell});
    }
  return list;
}
LawScene law_of(const Composition& c) {
  LawScene law = soft_law();
  if (!c.adhesion) law.attraction = 0;
  if (!c.damping) law.damping = 0;
  if (!c.friction) law.friction = 0;
  law.rolling = c.rolling;
  return law;
}

// Cut anywhere, the run through a state file gives the bits of the straight run, lists in mid-life included.
TEST(Determinism, ARestartIsTheStraightRun) {
  const TemporaryFolder folder;
  const std::string path = folder / "state.h5";
  for (const Composition& c : compositions()) {
    SCOPED_TRACE(std::string(c.name) + (c.adhesion ? " adhesion" : "") + (c.free_cell ? " free cell" : ""));
    RandomDisks r;
    r.law = law_of(c), r.speed = 2;
    const State start = random_state(r);
    // Fast compression: lists rebuild every few steps.
    const CellControl control = c.free_cell ? barostat(start, 100) : CellControl{};
    SolverOptions watched;
    watched.energies = true;
    Solver straight(start, control, watched);
    straight.run(150);
    EXPECT_GT(straight.lists().inner_rebuilds(), 5u);
    State end = start;
    straight.snapshot(end);
    for (std::int64_t cut : {1, 37, 149}) {
      write_state(marched(start, control, cut, watched), path);
      EXPECT_EQ(bytes(marched(read_state(path), control, 150 - cut, watched)), bytes(end)) << "cut at step " << cut;
    }
  }
}

// The ledger is kept by a dearer kernel; the physics does not notice. Snapshots only read.
TEST(Determinism, WatchingChangesNothing) {
  for (const Composition& c : compositions()) {
    SCOPED_TRACE(std::string(c.name) + (c.adhesion ? " adhesion" : "") + (c.free_cell ? " free cell" : ""));
    RandomDisks r;
    r.law = law_of(c), r.speed = 2, r.seed = 9;
    const State start = random_state(r);
    const CellControl control = c.free_cell ? barostat(start, 100) : CellControl{};
    const State plain = marched(start, control, 120);
    SolverOptions watched;
    watched.energies = true;
    Solver solver(start, control, watched);
    State seen = start;
    for (int k = 0; k < 120; ++k) {
      solver.step();
      solver.snapshot(seen);
    }
    EXPECT_EQ(physical_hash(seen), physical_hash(plain));
    seen.ledger = plain.ledger;
    EXPECT_EQ(bytes(seen), bytes(plain));
  }
}

Scene small_scene() {
  Scene scene;
  scene.grains.count = 60;
  scene.grains.solid_fraction = 0.5;
  scene.law.normal_stiffness = 1e4;
  scene.law.attraction_range = 0.01;
  scene.step.fraction = 0.1;
  scene.finish.method = Finish::drag;
  scene.finish.quiet_time = 5;
  StageScene agitated;
  agitated.velocity = 10, agitated.until = "time", agitated.time = 3;
  StageScene compressed;
  compressed.pressure = 0.1, compressed.max_strain_rate = 0.1, compressed.until = "time", compressed.time = 6;
  scene.stages = {agitated, compressed};
  return scene;
}

TEST(Determinism, ObserversOfAStageChangeNothing) {
  const Scene scene = small_scene();
  State plain = initial_state(scene, 5);
  ASSERT_TRUE(run_stages(plain, {}, {}).all_met());

  Scene observed = scene;
  observed.output.snapshot_times = {0.5, 3.3, 7.77};
  observed.output.snapshot_solid_fractions = {0.52, 0.55};
  State seen = initial_state(observed, 5);
  int rows = 0, snapshots = 0, looks = 0, checkpoints = 0;
  RunHooks hooks;
  hooks.observe = [&](const State& s) { rows += !series_row(s, true).empty(); };
  hooks.observe_interval = 0.1;
  hooks.snapshot = [&](const State& s) { snapshots += !encode_state(s).empty(); };
  hooks.progress = [&](const Progress&) { ++looks; };
  hooks.checkpoint = [&](const State&) { ++checkpoints; };
  hooks.checkpoint_seconds = 1e-9;
  SolverOptions options;
  options.energies = true;
  ASSERT_TRUE(run_stages(seen, options, hooks).all_met());
  EXPECT_NEAR(rows, 90, 2);
  EXPECT_GE(snapshots, 5);
  EXPECT_GT(looks, 5);
  EXPECT_GT(checkpoints, 5);
  EXPECT_EQ(physical_hash(seen), physical_hash(plain));
  EXPECT_EQ(seen.step, plain.step);
}

// Interrupted again and again, through the state file, in both stages.
TEST(Determinism, AnInterruptedRunGoesOnAsIfItHadNotBeen) {
  const Scene scene = small_scene();
  State straight = initial_state(scene, 6);
  ASSERT_TRUE(run_stages(straight, {}, {}).all_met());
  const TemporaryFolder folder;
  const std::string path = folder / "state.h5";
  State s = initial_state(scene, 6);
  int interruptions = 0;
  for (bool done = false; !done && interruptions < 100;) {
    int polls = 0;
    RunHooks hooks;
    hooks.interrupted = [&] { return ++polls > 7; };
    hooks.observe = [](const State&) {};
    hooks.observe_interval = 0.0937;  // stops at odd steps
    const RunOutcome outcome = run_stages(s, {}, hooks);
    done = !outcome.interrupted;
    if (!done) {
      write_state(s, path);
      s = read_state(path);
      ++interruptions;
    }
  }
  EXPECT_GT(interruptions, 5);
  EXPECT_EQ(physical_hash(s), physical_hash(straight));
}

TEST(Determinism, TheSeedDecidesEverything) {
  const Scene scene = small_scene();
  State a = initial_state(scene, 7), b = initial_state(scene, 7), c = initial_state(scene, 8);
  run_stages(a, {}, {}), run_stages(b, {}, {}), run_stages(c, {}, {});
  EXPECT_EQ(bytes(a), bytes(b));
  EXPECT_NE(physical_hash(a), physical_hash(c));
}

}  // namespace
}  // namespace isostat
