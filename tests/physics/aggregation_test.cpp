// Method 2 to certified equilibrium on small samples: both series, restarts, and the limits of the paper's Sec. IV.B.
#include <gtest/gtest.h>

#include <cmath>

#include "analysis/finishing/newton_finishing.hpp"
#include "dem/disks/certificate.hpp"
#include "dem/disks/physical_hash.hpp"
#include "dem/disks/sample.hpp"
#include "dem/files/state_file.hpp"
#include "dem/run/stages.hpp"
#include "dem/scene/file.hpp"
#include "dem/state/clusters.hpp"

namespace isostat {
namespace {

Scene shipped(const std::string& name, int count, const std::vector<std::string>& more = {}) {
  std::vector<std::string> set{"grains.count=" + std::to_string(count)};
  set.insert(set.end(), more.begin(), more.end());
  return read_scene(ISOSTAT_DATA "/scenes/" + name, set);
}

struct Stop {
  State<Disks> state;
  std::size_t clusters;
};

std::vector<Stop> run(const Scene& scene, std::uint64_t seed) {
  NewtonFinishing newton;
  std::vector<Stop> ends;
  State<Disks> s = initial_disks(scene, seed);
  RunHooks<Disks> hooks;
  hooks.stage_end = [&](const State<Disks>& at) { ends.push_back({at, count_clusters(at.packing)}); };
  const RunOutcome o = run_stages(s, {}, hooks, &newton);
  for (const StageOutcome& stage : o.stages) EXPECT_TRUE(stage.met) << stage.stage << ": " << stage.reason;
  return ends;
}

double coordination(const State<Disks>& s) {
  return 2 * static_cast<double>(s.packing.links.size()) / static_cast<double>(s.packing.bodies.size());
}

TEST(Aggregation, SeriesAEndsInOneClusterThatCarriesTheLoad) {
  const std::vector<Stop> ends = run(shipped("disks-method2-a.toml", 80), 2);
  ASSERT_EQ(ends.size(), 3u);
  for (const Stop& e : ends) {
    EXPECT_EQ(e.clusters, 1u);
    EXPECT_TRUE(evaluate_certificate(e.state).equilibrated);
  }
  EXPECT_EQ(ends[0].state.packing.cell->length, ends[0].state.cell_motion.reference_length) << "the cell was fixed";
  EXPECT_LT(ends[2].state.packing.cell->measure(), 0.95 * ends[1].state.packing.cell->measure());
  EXPECT_LT(ends[2].state.certificate.max_force, 1e-7);
}

TEST(Aggregation, SeriesBRingsSoftlyAndIsStillFinished) {
  const Scene scene = shipped("disks-method2-b.toml", 60);
  const std::vector<Stop> ends = run(scene, 1);
  ASSERT_EQ(ends.size(), 4u);
  EXPECT_EQ(ends[1].state.law.normal_stiffness, 1e2);
  EXPECT_EQ(ends[2].state.law.normal_stiffness, 1e4);
  EXPECT_LT(ends[2].state.time_step, 0.11 * ends[1].state.time_step);
  for (const Stop& e : ends) EXPECT_TRUE(evaluate_certificate(e.state).equilibrated);
}

TEST(Aggregation, SlowGasWithRollingMakesTrees) {
  const Scene scene = shipped("disks-method2-a.toml", 40, {"stage.0.velocity=0.1"});
  const std::vector<Stop> ends = run(scene, 4);
  ASSERT_FALSE(ends.empty());
  EXPECT_EQ(ends[0].clusters, 1u);
  EXPECT_GE(coordination(ends[0].state), 2 - 2.0 / 40);  // a tree
  EXPECT_LT(coordination(ends[0].state), 2.15);          // hardly a loop (PHYSICS: 2.001 at .095 V*)
}

TEST(Aggregation, InterruptedWhileFlyingItEndsTheSame) {
  const Scene scene = shipped("disks-method2-a.toml", 40, {"stage.0.velocity=1.0"});
  const std::vector<Stop> straight = run(scene, 3);
  ASSERT_EQ(straight.size(), 3u);
  NewtonFinishing newton;
  State<Disks> s = initial_disks(scene, 3);
  int polls = 0, times = 0;
  RunHooks<Disks> stop;
  // Rarer and rarer: a static solve is begun anew each time, and must be left alone for once.
  stop.interrupted = [&] { return ++polls % (10 + 10 * times) == 0; };
  while (run_stages(s, {}, stop, &newton).interrupted) {
    s = std::get<State<Disks>>(decode_state(encode_state(s), "memory").state);
    polls = 0;
    ASSERT_LT(++times, 10000);
  }
  EXPECT_GT(times, 2);
  EXPECT_EQ(physical_hash(s), physical_hash(straight.back().state));
}

}  // namespace
}  // namespace isostat
