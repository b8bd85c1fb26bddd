// Stages of a scene: control of each direction, stiffening, load paths, and what ends a stage.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "dem/disks/energy.hpp"
#include "dem/disks/engine.hpp"
#include "dem/disks/physical_hash.hpp"
#include "dem/disks/sample.hpp"
#include "dem/disks/stage.hpp"
#include "dem/files/state_file.hpp"
#include "dem/run/stages.hpp"
#include "dem/scene/file.hpp"
#include "dem/state/clusters.hpp"

namespace isostat {
namespace {

using ::testing::HasSubstr;

Scene gas(int count = 40) {
  Scene scene;
  scene.grains.count = count;
  scene.grains.solid_fraction = 0.45;
  scene.law.normal_stiffness = 1e3;
  scene.law.attraction_range = 0.02;
  scene.step.fraction = 0.12;
  return scene;
}

StageScene aggregation() {
  StageScene s;
  s.velocity = 9.48, s.until = Until::aggregated;
  return s;
}

const State<Disks>& aggregate() {
  static const State<Disks> state = [] {
    Scene scene = gas();
    scene.finish.method = Finish::drag;
    scene.stages = {aggregation()};
    State<Disks> s = initial_disks(scene, 3);
    EXPECT_TRUE(run_stages(s, {}, {}).all_met());
    return s;
  }();
  return state;
}

// The stage run on the aggregate.
State<Disks> go_on(const StageScene& stage, RunOutcome* outcome = nullptr, bool energies = false) {
  State<Disks> s = aggregate();
  s.scene.finish.method = Finish::none;
  s.scene.stages = {stage};
  s.progress = {};
  SolverOptions options;
  options.energies = energies;
  const RunOutcome o = run_stages(s, options, {});
  if (outcome) *outcome = o;
  return s;
}

TEST(Stages, AggregationEndsWithOneClusterInEquilibrium) {
  EXPECT_EQ(count_clusters(aggregate().packing), 1u);
  EXPECT_TRUE(aggregate().certificate.equilibrated);
}

TEST(Stages, DrawnSpeedIsThatOfTheVectorOrOfEachComponent) {
  const auto drawn = [](VelocityOf of) {
    Scene scene = gas(400);
    StageScene stage;
    stage.velocity = 9.48, stage.velocity_of = of;
    scene.stages = {stage};
    State<Disks> s = initial_disks(scene, 3);
    agitate(s, stage);
    return s.packing.bodies.velocity;
  };
  const auto mean_square = [](const std::vector<Vec2>& v, auto of) {
    double sum = 0;
    for (const Vec2& u : v) sum += of(u);
    return sum / static_cast<double>(v.size());
  };
  const double v0 = 9.48 * std::sqrt(1.0 * 0.02);  // V* = sqrt(F0 D0 / m)
  const std::vector<Vec2> vector = drawn(VelocityOf::vector), component = drawn(VelocityOf::component);
  EXPECT_NEAR(mean_square(vector, [](const Vec2& u) { return dot(u, u); }), v0 * v0, 1e-12);
  EXPECT_NEAR(mean_square(component, [](const Vec2& u) { return dot(u, u); }), 2 * v0 * v0, 1e-12);
  // Each component then has V0 within its sampling error, V0^2 sqrt(2/N), of N = 400.
  for (const int a : {0, 1})
    EXPECT_NEAR(mean_square(component, [a](const Vec2& u) { return u[a] * u[a]; }), v0 * v0,
                4 * std::sqrt(2.0 / 400) * v0 * v0);
  for (std::size_t k = 0; k < vector.size(); ++k)
    EXPECT_LT(norm(component[k] - std::sqrt(2.0) * vector[k]), 1e-13) << "the same draw";
}

TEST(Stages, StiffeningFollowsTheExponentialAndKeepsTheEnergyLedger) {
  StageScene stage;
  stage.normal_stiffness = 1e4, stage.stiffening_time = 2, stage.until = Until::time, stage.time = 1;
  const State<Disks> half = go_on(stage, nullptr, true);
  EXPECT_NEAR(half.law.normal_stiffness, 1e3 * std::sqrt(10.0), 1e3 * std::sqrt(10.0) * 2e-2);
  EXPECT_EQ(half.law.tangential_stiffness, half.law.normal_stiffness);
  EXPECT_NEAR(half.law.rolling_stiffness, 1e-4 * half.law.normal_stiffness, 1e-9);
  EXPECT_NEAR(half.time_step, 0.12 * std::sqrt(1e-4) * aggregate().time_step / (0.12 * std::sqrt(1e-3)), 1e-9);
  const double before = energies(aggregate()).total(), after = energies(half).total();
  EXPECT_NEAR(after, before, 2e-4 * std::abs(energies(half).adhesive) + 1e-6);

  stage.time = 3;
  const State<Disks> whole = go_on(stage);
  EXPECT_EQ(whole.law.normal_stiffness, 1e4);
}

TEST(Stages, StiffeningKeepsTheForcesOfTheSpringsOrTheirElongations) {
  LawScene stiffer = aggregate().scene.law;
  stiffer.normal_stiffness *= 3;
  for (const Springs kept : {Springs::keep_forces, Springs::keep_elongations}) {
    State<Disks> s = aggregate();
    Solver solver(s, {});
    solver.set_law(resolve(stiffer), kept);
    solver.snapshot(s);
    const auto &before = aggregate().packing.links, &after = s.packing.links;
    ASSERT_EQ(after.size(), before.size());
    double springs = 0;
    for (std::size_t k = 0; k < after.size(); ++k) {
      const double factor = kept == Springs::keep_forces ? 1 : 3;
      EXPECT_DOUBLE_EQ(after[k].tangential_force, factor * before[k].tangential_force);
      EXPECT_DOUBLE_EQ(after[k].moment, factor * before[k].moment);
      springs += std::abs(before[k].tangential_force);
    }
    EXPECT_GT(springs, 0);
  }
}

TEST(Stages, StiffeningRestartsBitForBit) {
  for (const Springs kept : {Springs::keep_forces, Springs::keep_elongations}) {
    SCOPED_TRACE(kSpringsNames[static_cast<std::size_t>(kept)]);
    StageScene stage;
    stage.stiffening_keeps = kept;
    stage.normal_stiffness = 1e4, stage.stiffening_time = 2, stage.until = Until::time, stage.time = 1.5;
    const State<Disks> straight = go_on(stage);
    State<Disks> s = aggregate();
    s.scene.stages = {stage}, s.progress = {}, s.scene.finish.method = Finish::none;
    int polls = 0;
    RunHooks<Disks> stop;
    stop.interrupted = [&] { return ++polls > 25; };
    ASSERT_TRUE(run_stages(s, {}, stop).interrupted);
    ASSERT_LT(s.law.normal_stiffness, 1e4);
    s = std::get<State<Disks>>(decode_state(encode_state(s), "memory").state);
    run_stages(s, {}, {});
    EXPECT_EQ(physical_hash(s), physical_hash(straight));
  }
}

TEST(Stages, TensionTearsAPackingApart) {
  StageScene pressed, pulled;
  pressed.pressure = 0.5;
  pulled.strain_rate_1 = -5e-3, pulled.stress_2 = 0.0, pulled.ramp_time = 2, pulled.until = Until::failure;
  pulled.max_time = 300;
  Scene scene = gas(60);
  scene.finish.method = Finish::drag;
  scene.stages = {pressed, pulled};
  State<Disks> s = initial_disks(scene, 3);
  Vec2 before;
  RunHooks<Disks> hooks;
  hooks.stage_end = [&](const State<Disks>& at) {
    if (at.progress.stage == 1) before = at.packing.cell->length;
  };
  const RunOutcome outcome = run_stages(s, {}, hooks);
  ASSERT_TRUE(outcome.all_met()) << outcome.stages.back().reason;
  EXPECT_GT(s.packing.cell->length[0], before[0]);
  EXPECT_GT(s.progress.peak_stress, 0.02);
  EXPECT_LT(s.progress.carried_stress, 0.5 * s.progress.peak_stress);
  EXPECT_NEAR(s.cell_motion.strain_rate[0], -5e-3, 1e-15);
}

TEST(Stages, StrainEndsADrivenStage) {
  StageScene stage;
  stage.strain_rate_2 = 0.05, stage.until = Until::strain, stage.strain = 0.02;
  RunOutcome outcome;
  const State<Disks> s = go_on(stage, &outcome);
  EXPECT_TRUE(outcome.all_met());
  EXPECT_NEAR(1 - s.packing.cell->length[1] / aggregate().packing.cell->length[1], 0.02, 0.05 * 1.1);
  EXPECT_GE(1 - s.packing.cell->length[1] / aggregate().packing.cell->length[1], 0.02);
  EXPECT_EQ(s.packing.cell->length[0], aggregate().packing.cell->length[0]) << "nothing moves that direction";
}

TEST(Stages, LoadPathBecomesStages) {
  const Scene scene = parse_scene(
      "[law]\nnormal_stiffness = 1e5\n[[stage]]\nvelocity = 2\npressures = [0.01, 0.1, 0.01]\n[[stage]]\nuntil = "
      "\"time\"\ntime = 1\n",
      "scene.toml");
  ASSERT_EQ(scene.stages.size(), 4u);
  EXPECT_EQ(scene.stages[1].pressure, 0.1);
  EXPECT_EQ(scene.stages[2].pressure, 0.01);
  EXPECT_EQ(scene.stages[0].velocity, 2);
  EXPECT_EQ(scene.stages[1].velocity, 0);
  EXPECT_EQ(scene.stages[3].until, Until::time);
  EXPECT_TRUE(scene.stages[0].pressures.empty());
}

TEST(Stages, EveryStageEndIsSeen) {
  Scene scene = gas(20);
  StageScene brief;
  brief.until = Until::time, brief.time = 0.2;
  scene.stages = {brief, brief, brief};
  State<Disks> s = initial_disks(scene, 1);
  std::vector<int> ends;
  RunHooks<Disks> hooks;
  hooks.stage_end = [&](const State<Disks>& at) { ends.push_back(at.progress.stage); };
  run_stages(s, {}, hooks);
  EXPECT_EQ(ends, (std::vector<int>{1, 2, 3}));
}

std::string refused(const std::string& stage) {
  try {
    parse_scene("[[stage]]\n" + stage, "scene.toml");
  } catch (const std::exception& e) {
    return e.what();
  }
  return "";
}

TEST(Stages, ImpossibleControlIsRefused) {
  EXPECT_THAT(refused("stress_1 = 0.1\nstrain_rate_1 = 0.1\nuntil = \"strain\"\nstrain = 0.1\n"),
              HasSubstr("stage.0.strain_rate_1"));
  EXPECT_THAT(refused("strain_rate_1 = 0.1\n"), HasSubstr("never comes to rest"));
  EXPECT_THAT(refused("pressure = 0.1\nuntil = \"failure\"\n"), HasSubstr("needs a strain rate"));
  EXPECT_THAT(refused("strain_rate_1 = 0.1\nuntil = \"strain\"\n"), HasSubstr("stage.0.strain"));
  EXPECT_THAT(refused("pressure = 0.1\npressures = [0.1]\n"), HasSubstr("either pressure or pressures"));
}

}  // namespace
}  // namespace isostat
