// isostat pack: exit codes, files, interruption and resumption, observers, runs that blow up.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <nlohmann/json.hpp>

#include "dem/disks/physical_hash.hpp"
#include "dem/files/state_file.hpp"
#include "tests/apps/child.hpp"
#include "tests/apps/program.hpp"

namespace isostat {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

class Pack : public Program {
 protected:
  Pack() { write("scene.toml", quick_scene(60)); }
  std::string pack(const std::string& output, const std::string& more = "") const {
    return "pack " + in_folder("scene.toml") + " -o " + in_folder(output) + " " + more;
  }
  std::string hash(const std::string& name) const { return read_state_file(in_folder(name)).hash; }
  std::vector<std::string> lines(const std::string& name) const {
    std::vector<std::string> list;
    std::istringstream in(content(in_folder(name)));
    for (std::string line; std::getline(in, line);) list.push_back(line);
    return list;
  }

  // Starts the program, waits until the series has so many lines, sends the signal; the exit code.
  int interrupted(const std::string& arguments, const std::string& series, std::size_t rows, int signal) const {
    Child child(ISOSTAT_PROGRAM " " + arguments + " 2>" + in_folder("stderr"), in_folder(""));
    EXPECT_TRUE(child.wait_for([&] { return lines(series).size() >= rows; })) << content(in_folder("stderr"));
    const int status = child.end_by(signal);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
};

TEST_F(Pack, RunsTheStagesAndWritesOneState) {
  const Outcome o = run(pack("state.h5", "--timings " + in_folder("t.json")));
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(o.out, "");
  EXPECT_THAT(o.err, HasSubstr("kappa 1e+04"));
  EXPECT_FALSE(exists("state.h5.partial"));
  const State<Disks> s = read_state<Disks>(in_folder("state.h5"));
  EXPECT_EQ(s.packing.bodies.size(), 60u);
  EXPECT_NEAR(s.time, 5, 2 * s.time_step);
  EXPECT_EQ(s.seed, 3u);
  EXPECT_EQ(s.progress.stage, 2);
  const json t = json::parse(content(in_folder("t.json")));
  EXPECT_EQ(t["steps"], s.step);
  EXPECT_EQ(t["grain_steps"], 60 * s.step);
  EXPECT_GT(t["cpu_seconds"], 0);
  EXPECT_GT(t["wall_seconds"], 0);
  EXPECT_TRUE(t["stages"].is_object() && !t["stages"].empty());
}

// A row of ten disks that closes on itself, pulled along it.
TEST_F(Pack, SaysWhichStageWasNotQuasiStatic) {
  std::string row = "cell 9.99 4\n";
  for (int k = 0; k < 10; ++k) row += "grain " + std::to_string(k) + " " + std::to_string(0.999 * k) + " 2 .5\n";
  write("row.net", row);
  const auto told = [&](const std::string& stage, const std::string& more = "") {
    write("scene.toml", "[grains]\nfile = \"" + in_folder("row.net") +
                            "\"\n[law]\nnormal_stiffness = 1e3\n[[stage]]\nuntil = \"time\"\ntime = 2\n" + stage);
    const Outcome o = run(pack("row.h5", "--force " + more));
    EXPECT_EQ(o.code, 0) << o.err;
    return o.err;
  };
  EXPECT_THAT(told("strain_rate_1 = -2e-3\n"), HasSubstr("not quasi-static, stage 0: inertial number up to 0.002"));
  EXPECT_THAT(told("strain_rate_1 = -5e-4\n"), Not(HasSubstr("quasi-static")));
  EXPECT_THAT(told("strain_rate_1 = -5e-4\nstress_2 = 0.1\nmax_strain_rate = 5e-4\n"), Not(HasSubstr("quasi-static")))
      << "on its way to the stress";
  const std::string next =
      "strain_rate_1 = 9e-4\n[[stage]]\nuntil = \"time\"\ntime = 6\nstress_1 = 0.45\nramp_time = 0.1\n";
  EXPECT_THAT(told(next, "--set cell.inertia=1000"), HasSubstr("not quasi-static, stage 1: stress off by up to"))
      << "a heavy cell moves on";
  EXPECT_THAT(told(next, "--set cell.inertia=0.03 --set cell.damping=30"), Not(HasSubstr("quasi-static")));
}

TEST_F(Pack, SeedSetAndThreads) {
  ASSERT_EQ(run(pack("a.h5")).code, 0);
  ASSERT_EQ(run(pack("b.h5", "--threads 3")).code, 0);
  EXPECT_EQ(content(in_folder("a.h5")), content(in_folder("b.h5"))) << "same scene, same bytes";
  ASSERT_EQ(run(pack("c.h5", "--seed 4")).code, 0);
  EXPECT_NE(hash("c.h5"), hash("a.h5"));
  EXPECT_EQ(read_state<Disks>(in_folder("c.h5")).seed, 4u);
  ASSERT_EQ(run(pack("d.h5", "--set law.friction=0.1 --set stage.1.time=1 --set law.rolling=false")).code, 0);
  const State<Disks> d = read_state<Disks>(in_folder("d.h5"));
  EXPECT_EQ(d.law.friction, 0.1);
  EXPECT_EQ(d.law.rolling_friction, 0);
  EXPECT_NEAR(d.time, 3, 2 * d.time_step);
}

TEST_F(Pack, SamplesAreTheRunsOfTheirSeeds) {
  ASSERT_EQ(run(pack("many.h5", "--samples 3 --threads 2")).code, 0);
  ASSERT_EQ(run(pack("one.h5", "--seed 5")).code, 0);
  EXPECT_FALSE(exists("many.h5"));
  EXPECT_TRUE(exists("many.0001.h5") && exists("many.0002.h5"));
  EXPECT_EQ(hash("many.0003.h5"), hash("one.h5"));
  EXPECT_NE(hash("many.0001.h5"), hash("many.0002.h5"));
}

TEST_F(Pack, MaxTimeAndMissedEndsExitWithThreeAndKeepTheState) {
  const Outcome o = run(pack("state.h5", "--max-time 3"));
  EXPECT_EQ(o.code, 3);
  EXPECT_THAT(o.err, HasSubstr("--max-time"));
  EXPECT_NEAR(read_state<Disks>(in_folder("state.h5")).time, 3, 0.6);
  const Outcome e =
      run(pack("other.h5", "--set stage.1.until='\"equilibrium\"' --set stage.1.time=0 --set stage.1.max_time=1"));
  EXPECT_EQ(e.code, 3);
  EXPECT_THAT(e.err, HasSubstr("stage 1 did not meet its end"));
  EXPECT_THAT(e.err, HasSubstr("stage.max_time"));
  EXPECT_TRUE(exists("other.h5"));
}

TEST_F(Pack, SeriesAndSnapshotsOnlyWatch) {
  ASSERT_EQ(run(pack("plain.h5")).code, 0);
  const Outcome o =
      run(pack("seen.h5", "--set output.series='\"" + in_folder("series.csv") +
                              "\"' --set output.series_interval=0.25 --set output.energies=true"
                              " --set output.snapshot_times=[1.0,4.0] --set output.snapshot_solid_fractions=[0.502]"));
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(hash("seen.h5"), hash("plain.h5"));
  const std::vector<std::string> rows = lines("series.csv");
  ASSERT_EQ(rows.size(), 21u);
  EXPECT_THAT(rows[0], HasSubstr("t,Phi,L1,L2,"));
  EXPECT_THAT(rows[0], HasSubstr("E_total"));
  const auto columns = std::count(rows[0].begin(), rows[0].end(), ',');
  for (std::size_t k = 1; k < rows.size(); ++k) {
    EXPECT_EQ(std::count(rows[k].begin(), rows[k].end(), ','), columns);
    EXPECT_NEAR(std::stod(rows[k]), 0.25 * static_cast<double>(k), 0.01);
  }
  EXPECT_NEAR(read_state<Disks>(in_folder("seen.snapshot0001.h5")).time, 1, 0.01);
  EXPECT_TRUE(exists("seen.snapshot0003.h5"));
  EXPECT_FALSE(exists("seen.snapshot0004.h5"));
}

TEST_F(Pack, SnapshotsAtMultiplesOfAnInterval) {
  ASSERT_EQ(run(pack("plain.h5")).code, 0);
  ASSERT_EQ(run(pack("seen.h5", "--set output.snapshot_interval=1.5 --set output.snapshot_times=[1.0,3.0]")).code, 0);
  EXPECT_EQ(hash("seen.h5"), hash("plain.h5"));
  const std::vector<double> times{1, 1.5, 3, 4.5};  // one file where both ask for it
  for (std::size_t k = 0; k < times.size(); ++k)
    EXPECT_NEAR(read_state<Disks>(in_folder("seen.snapshot000" + std::to_string(k + 1) + ".h5")).time, times[k], 0.01);
  EXPECT_FALSE(exists("seen.snapshot0005.h5"));
  const Outcome o = run(pack("bad.h5", "--set output.snapshot_interval=0"));
  EXPECT_EQ(o.code, 2);
  EXPECT_THAT(o.err, HasSubstr("output.snapshot_interval = 0"));
}

TEST_F(Pack, InterruptedRunsResumeToTheSameBits) {
  const std::string more = " --set stage.1.time=200 --set output.series='\"" + in_folder("series.csv") +
                           "\"' --set output.snapshot_times=[0.5,150.0]";
  ASSERT_EQ(run(pack("straight.h5", more)).code, 0);
  const std::string straight_series = content(in_folder("series.csv"));
  fs::remove(in_folder("series.csv"));
  std::ofstream(in_folder("cut.h5")) << "an older result";
  std::ofstream(in_folder("cut.snapshot0001.h5.tmp.1.2")) << "what a killed run left";

  for (const int signal : {SIGINT, SIGTERM}) {
    const std::size_t rows = signal == SIGINT ? 3 : 60;
    const std::string again = signal == SIGINT ? " --force" : " --resume";
    const int code = interrupted(pack("cut.h5", more + again), "series.csv", rows, signal);
    ASSERT_EQ(code, 130) << content(in_folder("stderr"));
    EXPECT_THAT(content(in_folder("stderr")), HasSubstr("--resume"));
    ASSERT_TRUE(exists("cut.h5.partial"));
    EXPECT_EQ(content(in_folder("cut.h5")), "an older result") << "replaced only when the new one is complete";
    EXPECT_LT(read_state<Disks>(in_folder("cut.h5.partial")).time, 200);
  }

  const Outcome other = run(pack("cut.h5", "--resume"));
  EXPECT_EQ(other.code, 2) << "another scene";
  EXPECT_THAT(other.err, HasSubstr("the scene differs"));
  EXPECT_EQ(run(pack("cut.h5", more + " --resume --seed 9")).code, 2) << "another seed";
  ASSERT_TRUE(exists("cut.h5.partial"));

  ASSERT_EQ(run(pack("cut.h5", more + " --resume")).code, 0);
  EXPECT_FALSE(exists("cut.h5.partial"));
  EXPECT_EQ(hash("cut.h5"), hash("straight.h5"));
  EXPECT_EQ(content(in_folder("series.csv")), straight_series);
  EXPECT_NEAR(read_state<Disks>(in_folder("cut.snapshot0002.h5")).time, 150, 0.1);
  EXPECT_FALSE(exists("cut.snapshot0003.h5"));

  const std::string finished = content(in_folder("cut.h5"));
  EXPECT_EQ(run(pack("cut.h5", more + " --resume")).code, 0) << "nothing left to do";
  EXPECT_EQ(content(in_folder("cut.h5")), finished);
}

TEST_F(Pack, ARunThatBlowsUpSaysWhereAndWhatToTurn) {
  const Outcome o = run(pack("state.h5", "--set stage.0.velocity=1e6"));
  EXPECT_EQ(o.code, 3);
  EXPECT_THAT(o.err, HasSubstr("step "));
  EXPECT_THAT(o.err, HasSubstr("grain "));
  EXPECT_THAT(o.err, HasSubstr("in one step"));
  EXPECT_THAT(o.err, HasSubstr("step.fraction or stage.velocity"));
  EXPECT_TRUE(exists("state.h5")) << "the last sane state";

  // Nothing holds the cell of a single grain up: in the end the grain would touch itself.
  const Outcome squeezed =
      run(pack("other.h5", "--set grains.count=1 --set stage.1.pressure=10 --set stage.1.max_strain_rate=1"));
  EXPECT_EQ(squeezed.code, 3) << squeezed.err;
  EXPECT_THAT(squeezed.err, HasSubstr("would touch itself"));
  EXPECT_THAT(squeezed.err, HasSubstr("stage.pressure"));
}

TEST_F(Pack, BadInputWritesNothing) {
  for (const std::string& bad :
       {std::string("--set grains.count=0"), std::string("--set law.friction=-1"), std::string("--set step.fraction=5"),
        std::string("--set law.normal_stiffness=1e300"), std::string("--set stage.7.time=1"),
        std::string("--samples 0"), std::string("--max-time -1"), std::string("--set law.damping=nan"),
        std::string("--no-such-option"), std::string("--set output.series='\"" + in_folder("no/folder/s.csv") + "\"'"),
        std::string("--timings " + in_folder("no/folder/t.json"))}) {
    const Outcome o = run(pack("state.h5", bad));
    EXPECT_EQ(o.code, 2) << bad << '\n' << o.err;
    EXPECT_EQ(o.out, "");
    EXPECT_THAT(o.err, Not(HasSubstr("internal"))) << bad;
    EXPECT_FALSE(exists("state.h5") || exists("state.h5.partial")) << bad;
  }
  EXPECT_EQ(run("pack " + in_folder("missing.toml") + " -o " + in_folder("state.h5")).code, 2);
  EXPECT_EQ(run("pack " + in_folder("scene.toml")).code, 2) << "no -o";
  EXPECT_EQ(run("pack " + in_folder("scene.toml") + " -o " + in_folder("state.txt")).code, 2);
  EXPECT_FALSE(exists("state.h5") || exists("state.txt"));
}

}  // namespace
}  // namespace isostat
