// How stages load a packing: ramps, inertial number, stress error, and what counts as failure.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <vector>

#include "dem/disks/certificate.hpp"
#include "dem/disks/engine.hpp"
#include "dem/disks/outflow.hpp"
#include "dem/disks/physical_hash.hpp"
#include "dem/disks/sample.hpp"
#include "dem/disks/stage.hpp"
#include "dem/files/state_file.hpp"
#include "dem/run/loading.hpp"
#include "dem/run/stage_end.hpp"
#include "dem/run/stages.hpp"
#include "dem/scene/file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace isostat {
namespace {

using ::testing::HasSubstr;

// Ten disks in a row that closes on itself through the cell; `overlap` [F0 / K_N] of each contact: 1 carries no force,
// 5 a compression of 4 F0.
State<Disks> chain(double overlap, const std::vector<StageScene>& stages) {
  constexpr double kStiffness = 1e3;
  constexpr int kDisks = 10;
  const TemporaryFolder folder;
  const double spacing = 1 - overlap / kStiffness;
  std::ofstream file(folder / "chain.net");
  file.precision(17);
  file << "cell " << kDisks * spacing << " 4\n";
  for (int k = 0; k < kDisks; ++k) file << "grain " << k << " " << k * spacing << " 2 .5\n";
  file.close();
  Scene scene;
  scene.grains.file = folder / "chain.net";
  scene.law.normal_stiffness = kStiffness, scene.law.attraction_range = 1e-3;
  scene.stages = stages;
  return initial_disks(scene, 1);
}

StageScene stretched(double rate, double ramp_time = 0) {
  StageScene s;
  s.strain_rate_1 = -rate, s.ramp_time = ramp_time, s.until = Until::failure, s.max_time = 300;
  return s;
}

TEST(Ramp, GoesLinearlyFromWhatItWasToWhatIsAsked) {
  CellControl<2> c;
  c.stress = {3.0, std::nullopt}, c.strain_rate = {{0, -0.2}};
  c.ramp = {10, 4, {{1, 7}}, {{0, 0.2}}};
  EXPECT_EQ(c.at(0).stress[0], 1.0) << "before it begins";
  EXPECT_EQ(c.at(10).strain_rate[1], 0.2);
  EXPECT_DOUBLE_EQ(*c.at(11).stress[0], 1.5);
  EXPECT_DOUBLE_EQ(c.at(11).strain_rate[1], 0.1);
  EXPECT_NEAR(c.at(12).strain_rate[1], 0, 1e-17);
  for (const double after : {14.0, 15.0, 1e9}) {
    EXPECT_EQ(c.at(after).stress[0], 3.0);
    EXPECT_EQ(c.at(after).strain_rate[1], -0.2);
    EXPECT_FALSE(c.at(after).stress[1]);
  }
}

TEST(Ramp, OfARateToRestStillMovesTheCell) {
  CellControl<2> c;
  c.ramp.strain_rate = {{0.1, 0}};
  EXPECT_FALSE(c.moves()) << "at once";
  c.ramp.length = 1;
  EXPECT_TRUE(c.moves());
}

// Two stages; the second begins where the first stands: its edge moves on at its speed, its stress is that which was
// there.
TEST(Ramp, BeginsWithTheSpeedAndTheStressThatAreThere) {
  StageScene first, second;
  first.strain_rate_1 = -1e-3, first.until = Until::time, first.time = 0.5;
  second.strain_rate_1 = 2e-3, second.stress_2 = 0.1, second.ramp_time = 1, second.until = Until::time, second.time = 2;
  State<Disks> s = chain(3, {first, second});
  std::vector<double> speed, imposed, time;
  RunHooks<Disks> hooks;
  hooks.observe_interval = 0.1;
  hooks.observe = [&](const State<Disks>& at) {
    if (at.progress.stage != 1) return;
    speed.push_back(at.cell_motion.strain_rate[0] * at.cell_motion.reference_length[0]);
    imposed.push_back(at.imposed_stress[1].value()), time.push_back(at.time - at.progress.start_time);
  };
  const double length = s.packing.cell->length[0];
  ASSERT_TRUE(run_stages(s, {}, hooks).all_met());
  ASSERT_GT(time.size(), 10u);
  const double after = s.cell_motion.reference_length[0], from = -1e-3 * length, to = 2e-3 * after;
  for (std::size_t k = 0; k < time.size(); ++k) {
    const double part = std::min(time[k], 1.0);
    EXPECT_NEAR(speed[k], from + part * (to - from), 2 * s.time_step * (to - from)) << time[k];
    EXPECT_NEAR(imposed[k], part * 0.1, 1e-6) << "no stress along direction 2 before";
  }
}

TEST(Ramp, RestartsBitForBitAndOutlastsEquilibrium) {
  StageScene hold;
  hold.pressure = 0.5, hold.ramp_time = 6, hold.max_strain_rate = 1e-3, hold.max_time = 200;
  hold.until = Until::time, hold.time = 9;
  State<Disks> straight = chain(2, {hold}), s = straight;
  run_stages(straight, {}, {});
  int polls = 0;
  RunHooks<Disks> stop;
  stop.interrupted = [&] { return ++polls > 4; };
  ASSERT_TRUE(run_stages(s, {}, stop).interrupted);
  ASSERT_LT(s.time, 6) << "within the ramp";
  ASSERT_GT(s.time, 1);
  s = std::get<State<Disks>>(decode_state(encode_state(s), "memory").state);
  run_stages(s, {}, {});
  EXPECT_EQ(physical_hash(s), physical_hash(straight));

  StageScene still;  // a chain without stress at P = 0 is at rest from the beginning
  still.stress_1 = 0.0, still.ramp_time = 7;
  State<Disks> resting = chain(1, {still});
  ASSERT_TRUE(run_stages(resting, {}, {}).all_met());
  EXPECT_GE(resting.time, 7 - resting.time_step);
}

TEST(Loading, InertialNumberIsThatOfTheFastestEdgeAndTheLargestForce) {
  State<Disks> s = chain(1, {StageScene{}});
  s.cell_motion.reference_length = s.packing.cell->length;
  s.packing.cell->length[1] *= 0.5;
  EXPECT_EQ(inertial_number(s), 0);
  s.cell_motion.strain_rate = {{-3e-3, 2e-3}};  // of L0: along 2, of half that length, it is 4e-3
  s.imposed_stress = {0.5, std::nullopt};
  EXPECT_DOUBLE_EQ(inertial_number(s), 4e-3) << "F1 = F0";
  s.imposed_stress = {-16.0, 4.0};
  EXPECT_DOUBLE_EQ(inertial_number(s), 1e-3) << "F1 = a P";
  s.law.attraction = 0;
  s.imposed_stress = {};
  s.packing.links.clear();
  for (double& m : s.packing.bodies.mass) m = 1;
  EXPECT_TRUE(std::isinf(inertial_number(s))) << "no force at all";
}

TEST(Loading, StressErrorIsMeasuredFromTheRangeBetweenBeforeAndNow) {
  State<Disks> s = chain(5, {StageScene{}});  // 4 F0 over a width of 4: sigma_11 = 1
  {
    Solver solver(s, {});
    solver.snapshot(s);
  }
  s.certificate.force_scale = 1;
  ASSERT_NEAR(static_stress(s)[0], 1, 1e-2);
  const double sigma = static_stress(s)[0];
  s.imposed_stress = {2.0, std::nullopt};
  s.progress.ramp_stress = {{0.5, 0}};
  EXPECT_EQ(stress_error(s), 0) << "on its way from .5 to 2";
  s.progress.ramp_stress = {{1.5, 0}};
  EXPECT_DOUBLE_EQ(stress_error(s), (1.5 - sigma) / 2) << "below both";
  s.imposed_stress = {0.25, std::nullopt};
  s.progress.ramp_stress = {{0.5, 0}};
  EXPECT_DOUBLE_EQ(stress_error(s), (sigma - 0.5) / 0.5) << "above both";
  s.imposed_stress = {0.0, std::nullopt};
  s.progress.ramp_stress = {};
  EXPECT_DOUBLE_EQ(stress_error(s), sigma / 0.01) << "nothing is imposed: a hundredth of F1/a is the unit";
}

TEST(Loading, TheCertificateKeepsTheLargestOfTheStage) {
  StageScene fast;
  fast.strain_rate_1 = -1e-3, fast.stress_2 = 0.0, fast.until = Until::time, fast.time = 2;
  StageScene rest;
  rest.strain_rate_1 = 0.0, rest.ramp_time = 5, rest.until = Until::time, rest.time = 8;
  State<Disks> s = chain(5, {fast, rest});
  std::vector<double> largest;
  RunHooks<Disks> hooks;
  hooks.stage_end = [&](const State<Disks>& at) { largest.push_back(at.certificate.inertial_number); };
  const RunOutcome outcome = run_stages(s, {}, hooks);
  ASSERT_EQ(largest.size(), 2u);
  EXPECT_NEAR(largest[0], 1e-3, 1e-5);
  EXPECT_NEAR(largest[1], 1e-3, 1e-5) << "at its start";
  EXPECT_EQ(inertial_number(s), 0) << "it has come to rest";
  EXPECT_EQ(outcome.stages[0].inertial_number, largest[0]);
  EXPECT_EQ(evaluate_certificate(s).inertial_number, largest[1]) << "kept when the packing is judged anew";
  const Certificate read = std::get<State<Disks>>(decode_state(encode_state(s), "memory").state).certificate;
  EXPECT_EQ(read.inertial_number, largest[1]);
}

TEST(Loading, AGasThatIsCompressedIsNotJudged) {
  Scene scene;
  scene.grains.count = 40;
  StageScene stage;
  stage.pressure = 0.1, stage.until = Until::time, stage.time = 1;
  scene.stages = {stage};
  State<Disks> s = initial_disks(scene, 1);
  run_stages(s, {}, {});
  EXPECT_TRUE(std::isnan(s.certificate.inertial_number));
  EXPECT_TRUE(std::isnan(s.certificate.stress_error));
}

// F0 is the strength of a contact; compressed or not, the chain loses it at one contact.
TEST(Failure, OfAChainIsSeenWhateverItCarriedBefore) {
  for (const double overlap : {1.0, 1.5, 5.0}) {
    State<Disks> s = chain(overlap, {stretched(1e-4, 5)});
    double tension = 0;
    RunHooks<Disks> hooks;
    hooks.observe_interval = 0.05;
    hooks.observe = [&](const State<Disks>& at) { tension = std::max(tension, -4 * static_stress(at)[0]); };
    const RunOutcome outcome = run_stages(s, {}, hooks);
    ASSERT_TRUE(outcome.all_met()) << overlap << ": " << outcome.stages.at(0).reason;
    EXPECT_NEAR(tension, 1, 0.02) << overlap;
    EXPECT_LT(s.time, 5 + 11 * overlap + 30) << overlap << ": soon after it";
  }
}

TEST(Failure, IsSeenUnderAStressThatGrows) {
  StageScene pulled;
  pulled.stress_1 = -0.5, pulled.ramp_time = 100, pulled.until = Until::failure, pulled.max_strain_rate = 1e-3;
  pulled.max_time = 300;  // F0 over a width of 4: it breaks at -.25
  State<Disks> s = chain(1, {pulled});
  const RunOutcome outcome = run_stages(s, {}, {});
  ASSERT_TRUE(outcome.all_met()) << outcome.stages.at(0).reason;
  EXPECT_GT(s.time, 45);
  EXPECT_LT(s.time, 80);
  EXPECT_GT(s.progress.peak_stress, 0.15);
  EXPECT_LT(s.progress.peak_stress, 0.25);
}

// A driven stage whose looks see the stress that is given them.
class Watched {
 public:
  explicit Watched(double rate) : s_(chain(1, {stage(rate)})), end_(s_, s_.scene.stages[0]) {
    s_.packing.links.resize(1);
    Link<2>& l = s_.packing.links[0];
    l = {}, l.i = 0, l.j = 1, l.shift = {};
  }
  static StageScene stage(double rate) {
    StageScene s = stretched(-rate);
    return s;
  }
  // sigma_11 [F0/a] at the next look.
  bool fails_at(double sigma) {
    Packing<2>& p = s_.packing;
    const double length = p.bodies.position[1][0] - p.bodies.position[0][0];
    p.links[0].normal_force = sigma * p.cell->measure() / length;
    s_.time += 0.5;
    end_.follow_peak();
    return end_.met();
  }

 private:
  State<Disks> s_;
  StageEnd<Disks> end_;
};

// Measured in a packing pulled at 1e-3 / T0: a first shock, then a stress that fluctuates.
TEST(Failure, IsNotAShockOrANoisyStress) {
  Watched w(-1e-3);
  EXPECT_FALSE(w.fails_at(-0.5));
  const double noise[] = {-0.12, -0.25, -0.18, -0.22, -0.13, -0.24, -0.2, -0.12, -0.12, -0.25};
  for (int k = 0; k < 200; ++k) ASSERT_FALSE(w.fails_at(noise[k % 10])) << k;
  for (int k = 0; k < 4; ++k) EXPECT_FALSE(w.fails_at(0)) << "no longer than a vibration";
  for (int k = 0; k < 40; ++k) ASSERT_FALSE(w.fails_at(noise[k % 10])) << k;
  int looks = 0;
  while (!w.fails_at(-0.01) && looks < 100) ++looks;
  EXPECT_GT(looks, 4);
  EXPECT_LT(looks, 40) << "but a loss that lasts is one";
}

TEST(Failure, InCompressionCountsWhatIsCarriedBeyondTheOtherDirection) {
  Watched w(1e-4);
  for (int k = 0; k < 60; ++k) ASSERT_FALSE(w.fails_at(0.01 * k));
  for (int k = 0; k < 100; ++k) ASSERT_FALSE(w.fails_at(0.4)) << "a part of the strength is left";
  int looks = 0;
  while (!w.fails_at(0.1) && looks < 100) ++looks;
  EXPECT_LT(looks, 40);
}

// In a slow test a slip takes many vibrations and still little of the strain.
TEST(Failure, IsNotASlipAfterWhichThePackingCarriesOn) {
  Watched w(-1e-5);
  for (int k = 0; k < 4000; ++k) ASSERT_FALSE(w.fails_at(-0.4)) << k;
  for (int k = 0; k < 80; ++k) ASSERT_FALSE(w.fails_at(-0.1)) << k << ": 40 vibrations, 2 % of the test";
  for (int k = 0; k < 1000; ++k) ASSERT_FALSE(w.fails_at(-0.4)) << k;
  int looks = 0;
  while (!w.fails_at(-0.01) && looks < 1000) ++looks;
  EXPECT_GT(looks, 80);
  EXPECT_LT(looks, 500) << "but a loss that lasts is one";
}

TEST(Failure, NeedsAPeak) {
  Watched w(-1e-3);
  for (int k = 0; k < 100; ++k) ASSERT_FALSE(w.fails_at(k % 2 ? 1e-4 : -1e-4)) << k;
}

std::string refused(const std::string& stage) {
  try {
    parse_scene("[[stage]]\n" + stage, "scene.toml");
  } catch (const std::exception& e) {
    return e.what();
  }
  return "";
}

TEST(Loading, RampsAndPathsWithoutAnEndAreRefused) {
  EXPECT_EQ(refused("pressure = 0.1\nramp_time = 0\n"), "") << "at once";
  EXPECT_THAT(refused("pressure = 0.1\nramp_time = -1\n"), HasSubstr("stage.0.ramp_time"));
  EXPECT_THAT(refused("until = \"time\"\ntime = 5\nramp_time = 1\n"), HasSubstr("only with a stress or strain rate"));
  EXPECT_THAT(refused("pressure = 0.1\nuntil = \"time\"\ntime = 5\nramp_time = 6\n"), HasSubstr("stage.0.time"));
  EXPECT_THAT(refused("pressure = 0.1\nmax_time = 5\nramp_time = 6\n"), HasSubstr("stage.0.max_time"));
  EXPECT_THAT(refused("pressures = []\n"), HasSubstr("at least one pressure"));
  EXPECT_THAT(refused("stress_1 = -2\nuntil = \"failure\"\n"), HasSubstr("stage.0.ramp_time"));
  EXPECT_EQ(refused("stress_1 = -2\nramp_time = 100\nuntil = \"failure\"\n"), "");
}

}  // namespace
}  // namespace isostat
