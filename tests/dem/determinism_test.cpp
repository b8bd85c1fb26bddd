// Determinism of whole runs, stage by stage; tests/systems has that of the step loop.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "dem/disks/engine.hpp"
#include "dem/disks/physical_hash.hpp"
#include "dem/disks/series.hpp"
#include "dem/files/state_file.hpp"
#include "dem/run/stages.hpp"
#include "tests/support/disk_states.hpp"
#include "tests/support/temporary_folder.hpp"

namespace isostat {
namespace {

// Digest of everything in the state, memory included: of the state file's bytes.
std::size_t bytes(State<Disks> s) {
  s.scene = Scene(), s.progress.stage = 0;  // keys that do not apply are not kept
  return std::hash<std::string>{}(encode_state(s));
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
  agitated.velocity = 10, agitated.until = Until::time, agitated.time = 3;
  StageScene compressed;
  compressed.pressure = 0.1, compressed.max_strain_rate = 0.1, compressed.until = Until::time, compressed.time = 6;
  scene.stages = {agitated, compressed};
  return scene;
}

TEST(Determinism, ObserversOfAStageChangeNothing) {
  const Scene scene = small_scene();
  State<Disks> plain = initial_disks(scene, 5);
  ASSERT_TRUE(run_stages(plain, {}, {}).all_met());

  Scene observed = scene;
  observed.output.snapshot_times = {0.5, 3.3, 7.77};
  observed.output.snapshot_solid_fractions = {0.52, 0.55};
  State<Disks> seen = initial_disks(observed, 5);
  int rows = 0, snapshots = 0, looks = 0, checkpoints = 0;
  RunHooks<Disks> hooks;
  hooks.observe = [&](const State<Disks>& s) { rows += !series_row(series_columns(s, true)).empty(); };
  hooks.observe_interval = 0.1;
  hooks.snapshot = [&](const State<Disks>& s) { snapshots += !encode_state(s).empty(); };
  hooks.progress = [&](const Progress&) { ++looks; };
  hooks.checkpoint = [&](const State<Disks>&) { ++checkpoints; };
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
  State<Disks> straight = initial_disks(scene, 6);
  ASSERT_TRUE(run_stages(straight, {}, {}).all_met());
  const TemporaryFolder folder;
  const std::string path = folder / "state.h5";
  State<Disks> s = initial_disks(scene, 6);
  int interruptions = 0;
  for (bool done = false; !done && interruptions < 100;) {
    int polls = 0;
    RunHooks<Disks> hooks;
    hooks.interrupted = [&] { return ++polls > 7; };
    hooks.observe = [](const State<Disks>&) {};
    hooks.observe_interval = 0.0937;  // stops at odd steps
    const RunOutcome outcome = run_stages(s, {}, hooks);
    done = !outcome.interrupted;
    if (!done) {
      write_state(s, path);
      s = read_state<Disks>(path);
      ++interruptions;
    }
  }
  EXPECT_GT(interruptions, 5);
  EXPECT_EQ(physical_hash(s), physical_hash(straight));
}

// One clock through the run: stages shorter than the time between checkpoints are checkpointed, too.
TEST(Determinism, ManyShortStagesShareOneCheckpointClock) {
  Scene scene = small_scene();
  StageScene stage = scene.stages[0];
  stage.velocity = 0, stage.time = 0.5;
  scene.stages.assign(1200, stage);
  scene.stages[0].velocity = 10;
  State<Disks> s = initial_disks(scene, 5);
  int checkpoints = 0;
  RunHooks<Disks> hooks;
  hooks.checkpoint = [&](const State<Disks>&) { ++checkpoints; };
  hooks.checkpoint_seconds = 0.02;
  const RunOutcome outcome = run_stages(s, {}, hooks);
  ASSERT_TRUE(outcome.all_met());
  ASSERT_GT(outcome.wall_seconds, 0.1);  // 1200 stages of less than a millisecond each
  EXPECT_GE(checkpoints, 3);
}

TEST(Determinism, TheSeedDecidesEverything) {
  const Scene scene = small_scene();
  State<Disks> a = initial_disks(scene, 7), b = initial_disks(scene, 7), c = initial_disks(scene, 8);
  run_stages(a, {}, {}), run_stages(b, {}, {}), run_stages(c, {}, {});
  EXPECT_EQ(bytes(a), bytes(b));
  EXPECT_NE(physical_hash(a), physical_hash(c));
}

}  // namespace
}  // namespace isostat
