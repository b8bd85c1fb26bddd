// isostat study: tables, what is done only once, interruption, failing rows, bad keys, stages, plots.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "analysis/figure/data_table.hpp"
#include "dem/files/state_file.hpp"
#include "tests/apps/child.hpp"
#include "tests/apps/program.hpp"

namespace isostat {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

class Study : public Program {
 protected:
  Study() { write("scene.toml", quick_scene(20)); }

  std::string study(const std::string& folder, const std::string& more = "") const {
    return "study " + in_folder("study.toml") + " -o " + in_folder(folder) + " " + more;
  }
  std::string text(const std::string& name) const { return content(in_folder(name)); }
  DataTable table(const std::string& name) const { return parse_table(text(name), name); }
  static double at(const DataTable& t, const std::string& name, std::size_t row) {
    return t.find(name) ? t.find(name)->value.at(row) : NAN;
  }
  // Name -> bytes and time of the last change.
  std::map<std::string, std::pair<std::string, fs::file_time_type>> files(const std::string& folder) const {
    std::map<std::string, std::pair<std::string, fs::file_time_type>> all;
    for (const auto& entry : fs::directory_iterator(in_folder(folder)))
      all[entry.path().filename().string()] = {content(entry.path().string()), entry.last_write_time()};
    return all;
  }
};

TEST_F(Study, OneEnsembleRowForEachParameterSet) {
  write("study.toml", R"(scene = "scene.toml"
seeds = 3
analyze = ["counts", "forces"]
[[row]]
name = "rr"
law.rolling = true
[[row]]
name = "no"
"law.rolling" = false
[grid]
"law.friction" = [0.15, 0.5]
)");
  const Outcome o = run(study("out", "-j 2"));
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(o.out, "");
  EXPECT_THAT(o.err, HasSubstr("12 runs: 12 ok"));
  const DataTable t = table("out/study.csv"), runs = table("out/runs.csv");
  ASSERT_EQ(t.rows(), 4u);
  EXPECT_THAT(t.columns[0].text,
              ElementsAre("rr-friction=0.15", "rr-friction=0.5", "no-friction=0.15", "no-friction=0.5"));
  EXPECT_THAT(t.find("law.rolling")->text, ElementsAre("true", "true", "false", "false"));
  EXPECT_THAT(t.find("law.friction")->value, ElementsAre(0.15, 0.5, 0.15, 0.5));
  EXPECT_THAT(t.find("n")->value, ElementsAre(3, 3, 3, 3));
  ASSERT_EQ(runs.rows(), 12u);

  // The statistics by hand, from the runs.
  for (std::size_t row = 0; row < 4; ++row) {
    double sum = 0, squares = 0;
    for (std::size_t k = 3 * row; k < 3 * row + 3; ++k) sum += at(runs, "z", k);
    for (std::size_t k = 3 * row; k < 3 * row + 3; ++k) squares += std::pow(at(runs, "z", k) - sum / 3, 2);
    EXPECT_NEAR(at(t, "counts.z", row), sum / 3, 1e-12);
    EXPECT_NEAR(at(t, "counts.z_sd", row), std::sqrt(squares / 2), 1e-12);
    EXPECT_NEAR(at(t, "counts.z_se", row), std::sqrt(squares / 6), 1e-12);
  }
  // The same as `analyze` of the row's states, and each state the one of `pack`.
  ASSERT_EQ(
      run("analyze " + in_folder("out/no-friction=0.5.*.h5") + " --only counts,forces --json " + in_folder("a.json"))
          .code,
      0);
  json analyzed = json::parse(text("a.json")), report = json::parse(text("out/no-friction=0.5.report.json"));
  analyzed.erase("inputs"), report.erase("inputs");
  EXPECT_EQ(analyzed, report);
  EXPECT_EQ(at(t, "counts.z", 3), report["counts"]["z"]["mean"]);
  ASSERT_EQ(run("pack " + in_folder("scene.toml") + " --seed 2 --set law.rolling=false --set law.friction=0.5 -o " +
                in_folder("p.h5"))
                .code,
            0);
  EXPECT_EQ(text("p.h5"), text("out/no-friction=0.5.0002.h5"));

  const json all = json::parse(text("out/study.json"));
  EXPECT_EQ(all["rows"][3]["scalars"]["counts.z"], report["counts"]["z"]);
  EXPECT_EQ(all["rows"][3]["set"]["law.rolling"], false);
  write("again.toml", all["rows"][3]["scene"]);
  ASSERT_EQ(run("pack " + in_folder("again.toml") + " --seed 2 -o " + in_folder("q.h5")).code, 0);
  EXPECT_EQ(read_state_file(in_folder("q.h5")).hash, read_state_file(in_folder("p.h5")).hash);
}

TEST_F(Study, TheSecondTimeNothingIsDoneAgain) {
  write("study.toml", "scene = \"scene.toml\"\nseeds = [4, 2]\nanalyze = [\"counts\"]\n");
  ASSERT_EQ(run(study("one", "-j 1")).code, 0);
  EXPECT_TRUE(exists("one/scene.0004.h5") && exists("one/scene.0002.h5"));
  const auto before = files("one");
  const Outcome again = run(study("one"));
  ASSERT_EQ(again.code, 0);
  EXPECT_THAT(again.err, Not(HasSubstr("[")));  // no line of a run
  const auto after = files("one");
  ASSERT_EQ(after.size(), before.size());
  for (const auto& [name, file] : before) {
    EXPECT_EQ(after.at(name).first, file.first) << name;
    if (name.ends_with(".h5") || name.ends_with(".run.json") || name.ends_with(".analysis.json")) {
      EXPECT_EQ(after.at(name).second, file.second) << name << " was written again";
    }
  }
  ASSERT_EQ(run(study("two", "-j 2")).code, 0);
  for (const char* name :
       {"study.csv", "scene.report.json", "scene.0002.h5", "scene.0004.h5", "scene.0002.analysis.json"})
    EXPECT_EQ(text("two/" + std::string(name)), before.at(name).first) << name;

  // More sections: the states stay, what was computed stays.
  write("study.toml", "scene = \"scene.toml\"\nseeds = [4, 2]\nanalyze = [\"counts\", \"stress\"]\n");
  ASSERT_EQ(run(study("one")).code, 0);
  EXPECT_EQ(files("one").at("scene.0002.h5").second, before.at("scene.0002.h5").second);
  EXPECT_TRUE(std::isfinite(at(table("one/study.csv"), "stress.pressure", 0)));
  // A report is believed only if it is of this state.
  fs::remove(in_folder("one/scene.0002.h5"));
  fs::copy_file(in_folder("one/scene.0002.analysis.json"), in_folder("one/scene.0004.analysis.json"),
                fs::copy_options::overwrite_existing);
  ASSERT_EQ(run(study("one")).code, 0);
  EXPECT_EQ(text("one/scene.0002.h5"), before.at("scene.0002.h5").first);
  EXPECT_NE(text("one/scene.0004.analysis.json"), text("one/scene.0002.analysis.json"));
  EXPECT_EQ(at(table("one/study.csv"), "counts.z", 0), at(table("two/study.csv"), "counts.z", 0));
}

TEST_F(Study, InterruptedStudiesResumeToTheSameBits) {
  write("study.toml", R"(scene = "scene.toml"
seeds = 3
[set]
stage.1.time = 800
output.series = "on"
)");
  ASSERT_EQ(run(study("straight", "-j 2")).code, 0);
  double reached = 0;  // [T0] where run 1 can be resumed
  for (const int signal : {SIGTERM, SIGINT, SIGKILL}) {
    // When run 1 has got some way further than the last time.
    const std::string series = in_folder("cut/scene.0001.series.csv"), partial = in_folder("cut/scene.0001.h5.partial");
    const auto rows = [&] {
      const std::string all = content(series);
      return std::count(all.begin(), all.end(), '\n');
    };
    const auto enough = rows() + 20;
    Child child(ISOSTAT_PROGRAM " " + study("cut", "-j 2") + " 2>" + in_folder("stderr"), in_folder("cut"));
    EXPECT_TRUE(child.wait_for([&] { return rows() >= enough; })) << text("stderr");
    const int status = child.end_by(signal);
    if (signal == SIGKILL) {
      EXPECT_TRUE(WIFSIGNALED(status));
      // The runs see that they are alone and stop by themselves; until then they hold the folder.
      const StudyLock lock(in_folder("cut"));
      ASSERT_TRUE(lock.held());
      const Outcome second = run(study("cut"));
      EXPECT_EQ(second.code, 2);
      EXPECT_THAT(second.err, HasSubstr("is in use by another isostat study"));
    } else {
      ASSERT_TRUE(WIFEXITED(status));
      EXPECT_EQ(WEXITSTATUS(status), 130) << text("stderr");
      EXPECT_THAT(text("stderr"), HasSubstr("goes on from here"));
      EXPECT_THAT(text("cut/runs.csv"), HasSubstr("pending"));
    }
    ASSERT_TRUE(fs::exists(partial));
    EXPECT_GT(read_state<Disks>(partial).time, reached);
    reached = read_state<Disks>(partial).time;
    EXPECT_FALSE(exists("cut/scene.0001.h5"));
  }
  const Outcome last = run(study("cut"));
  ASSERT_EQ(last.code, 0) << last.err;
  for (const char* name : {"study.csv", "scene.0001.h5", "scene.0002.h5", "scene.0003.h5", "scene.0001.series.csv"})
    EXPECT_EQ(text("cut/" + std::string(name)), text("straight/" + std::string(name))) << name;
  for (const auto& entry : fs::directory_iterator(in_folder("cut")))
    EXPECT_THAT(entry.path().string(), Not(HasSubstr(".tmp.")));
  EXPECT_GT(at(table("cut/runs.csv"), "cpu_seconds", 0), 0.3 * at(table("straight/runs.csv"), "cpu_seconds", 0));
}

TEST_F(Study, AFailingRowIsListedAndTheOthersFinish) {
  write("study.toml", R"(scene = "scene.toml"
seeds = 2
[[row]]
name = "boom"
stage.0.velocity = 1e6
[[row]]
name = "short"
stage.1 = {until = "equilibrium", time = 0, max_time = 1}
[[row]]
name = "lost"
grains.file = "missing.h5"
[[row]]
name = "fine"
)");
  const Outcome o = run(study("out"));
  EXPECT_EQ(o.code, 3) << o.err;
  EXPECT_THAT(o.err, HasSubstr("boom.0001: failed: the run blew up: step"));
  EXPECT_THAT(o.err, HasSubstr("short.0002: unfinished: stage 1 did not meet its end"));
  EXPECT_THAT(o.err, HasSubstr("lost.0001: failed: missing.h5"));
  const DataTable runs = table("out/runs.csv"), t = table("out/study.csv");
  EXPECT_THAT(runs.find("status")->text,
              ElementsAre("failed", "failed", "unfinished", "unfinished", "failed", "failed", "ok", "ok"));
  EXPECT_THAT(t.find("n")->value, ElementsAre(0, 0, 0, 2));
  EXPECT_THAT(t.find("runs")->value, ElementsAre(2, 2, 2, 2));
  EXPECT_TRUE(std::isnan(at(t, "counts.z", 0)) && std::isfinite(at(t, "counts.z", 3)));
  const auto before = files("out");
  const Outcome again = run(study("out"));
  EXPECT_EQ(again.code, 3) << "still listed";
  EXPECT_THAT(again.err, HasSubstr("boom.0001: failed: the run blew up: step"));
  EXPECT_EQ(text("out/runs.csv"), before.at("runs.csv").first);
  EXPECT_EQ(files("out").at("boom.0001.h5").second, before.at("boom.0001.h5").second) << "not run again";
}

TEST_F(Study, AnotherSceneInTheFolderIsRefusedOrRunAfresh) {
  const std::string base = "scene = \"scene.toml\"\nseeds = 2\n";
  write("study.toml", base);
  ASSERT_EQ(run(study("out")).code, 0);
  const auto before = files("out");
  write("study.toml", base + "[set]\nlaw.friction = 0.3\n");
  const Outcome refused = run(study("out"));
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.err, HasSubstr("out/scene.0001.h5"));
  EXPECT_THAT(refused.err, HasSubstr("law.friction = 0.5, not 0.3"));
  EXPECT_EQ(files("out"), before);
  ASSERT_EQ(run(study("out", "--fresh")).code, 0);
  EXPECT_NE(text("out/scene.0001.h5"), before.at("scene.0001.h5").first);
  EXPECT_EQ(at(table("out/study.csv"), "law.friction", 0), 0.3);
  // One state of pack is as good as one of our own.
  write("study.toml", base);
  ASSERT_EQ(run("pack " + in_folder("scene.toml") + " --seed 1 --force -o " + in_folder("out/scene.0001.h5")).code, 0);
  ASSERT_EQ(run(study("out", "--fresh")).code, 0);
  EXPECT_EQ(text("out/study.csv").size(), before.at("study.csv").first.size());
  EXPECT_EQ(text("out/scene.report.json"), before.at("scene.report.json").first);
  // A damaged state is bad input.
  write("out/scene.0002.h5", "no state");
  EXPECT_EQ(run(study("out")).code, 2);
  ASSERT_EQ(run(study("out", "--fresh")).code, 0);
  EXPECT_EQ(text("out/scene.0002.h5"), before.at("scene.0002.h5").first);
}

TEST_F(Study, EveryFaultOfTheFileIsListedAndNothingWritten) {
  write("study.toml", R"(scen = "scene.toml"
seeds = [1, 1]
analyze = ["count"]
stages = -1
[set]
seed = 4
[analysis]
cel = "free"
[[row]]
nam = "x"
[grid]
law.friction = 3
)");
  const Outcome own = run(study("out"));
  EXPECT_EQ(own.code, 2);
  for (const char* said : {"study.toml:1: scen: unknown key; did you mean scene?", "study.toml:2: seeds = [1, 1]",
                           "study.toml:3: analyze = \"count\": no section; did you mean counts?",
                           "study.toml:4: stages", "study.toml:6: seed", "study.toml:8: analysis.cel",
                           "study.toml:9: name: missing", "study.toml:10: nam", "study.toml:12: grid.law.friction"})
    EXPECT_THAT(own.err, HasSubstr(said));

  // Of the file, of the scene that is not there, and of settings: still all at once.
  write("study.toml",
        "scene = \"none.toml\"\nseeds = 0\nanalyse = [\"counts\"]\n[set]\nlaw.fricton = 0.1\nlaw.damping = -1\n");
  const Outcome mixed = run(study("out"));
  EXPECT_EQ(mixed.code, 2);
  for (const char* said : {"study.toml:2: seeds = 0", "study.toml:3: analyse: unknown key; did you mean analyze?",
                           "study.toml:5: law.fricton = 0.1: unknown key; did you mean law.friction?",
                           "study.toml:6: law.damping = -1", "none.toml: cannot be read"})
    EXPECT_THAT(mixed.err, HasSubstr(said));

  write("study.toml", R"(scene = "scene.toml"
seeds = 2
[set]
law.frictoin = 0.1
[[row]]
name = "a"
[[row]]
name = "b"
law.damping = -1
stages = [7]
[[row]]
name = "a"
[[row]]
name = "gone"
scene = "missing.toml"
)");
  const Outcome scenes = run(study("out"));
  EXPECT_EQ(scenes.code, 2);
  for (const char* said : {"study.toml:4: law.frictoin = 0.1: unknown key; did you mean law.friction?",
                           "study.toml:9: law.damping = -1", "study.toml:11: name = \"a\": names two", "missing.toml"})
    EXPECT_THAT(scenes.err, HasSubstr(said));
  const std::size_t at = scenes.err.find("law.frictoin");
  EXPECT_EQ(scenes.err.find("law.frictoin = 0.1", at + 1), std::string::npos) << "told once:\n" << scenes.err;

  for (const char* text :
       {"", "seeds = 2\n", "scene = \"scene.toml\"\n", "scene = \"scene.toml\"\nseeds = 0\n", "= 3",
        "scene = \"scene.toml\"\nseeds = 2\n[[row]]\nname = \"../x\"\n",
        "scene = \"scene.toml\"\nseeds = 2\nstages = 7\n",
        "scene = \"scene.toml\"\nseeds = 2\n[set]\nlaw.friction = 1\n[grid]\nlaw.friction = [1, 2]\n",
        "scene = \"scene.toml\"\nseeds = 2\nrow = 3\n",
        "scene = \"scene.toml\"\nseeds = 2\n[grid]\nlaw.friction = [0.1, 0.1]\n"}) {
    write("study.toml", text);
    const Outcome o = run(study("out"));
    EXPECT_EQ(o.code, 2) << text;
    EXPECT_THAT(o.err, HasSubstr("study.toml")) << text;
    EXPECT_THAT(o.err, Not(HasSubstr("internal"))) << o.err;
  }
  write("study.toml", "scene = \"scene.toml\"\nseeds = 2\n");
  EXPECT_EQ(run(study("out", "-j 0")).code, 2);
  EXPECT_EQ(run("study " + in_folder("study.toml")).code, 2);
  EXPECT_EQ(run("study " + in_folder("none.toml") + " -o " + in_folder("out")).code, 2);
  EXPECT_EQ(run(study("scene.toml")).code, 2) << "a file, not a folder";
  EXPECT_FALSE(exists("out"));
  EXPECT_EQ(text("scene.toml"), quick_scene(20));
}

TEST_F(Study, AFailedAnalysisIsListed) {
  write("study.toml", "scene = \"scene.toml\"\nseeds = 1\nanalyze = [\"counts\"]\n[analysis]\nk_max = 1e9\n");
  ASSERT_EQ(run(study("out")).code, 0);
  write("study.toml",
        "scene = \"scene.toml\"\nseeds = 1\nanalyze = [\"counts\", \"scattering\"]\n[analysis]\nk_max = 1e9\n");
  const Outcome o = run(study("out"));
  EXPECT_EQ(o.code, 3) << o.err;
  EXPECT_THAT(o.err, HasSubstr("analysis: "));
  EXPECT_THAT(table("out/runs.csv").find("status")->text, ElementsAre("ok"));
}

TEST_F(Study, OptionsOfTheAnalysisActAndMakeReportsAnew) {
  const std::string head = "scene = \"scene.toml\"\nseeds = 1\nanalyze = [\"pores\", \"scattering\"]\n[analysis]\n";
  const auto small = [&](const std::string& options) {
    write("study.toml", head + options);
    EXPECT_EQ(run(study("out")).code, 0) << options;
    return table("out/study.csv");
  };
  const DataTable plain = small("k_max = 12\n"),
                  other = small("k_max = 12\npore_size = 0.25\nk_window = [0.5, 9]\nfit_constant = \"zero\"\n");
  EXPECT_EQ(plain.find("pores.small.size")->value.at(0), 1);
  EXPECT_EQ(other.find("pores.small.size")->value.at(0), 0.25);
  EXPECT_EQ(other.find("scattering.fit.k_limit")->value.at(0), 9);
  EXPECT_EQ(other.find("scattering.fit.constant")->value.at(0), 0);
  for (const char* bad :
       {"k_window = [2, 1]\n", "k_window = [1]\n", "pore_window = [0, 1]\n", "pore_size = -1\n", "threshold = 0\n",
        "force = \"shear\"\n", "fit_constant = \"none\"\n", "window_scan = 1\n", "k_windows = [1, 2]\n"}) {
    write("study.toml", head + bad);
    const Outcome o = run(study("out"));
    EXPECT_EQ(o.code, 2) << bad;
    EXPECT_THAT(o.err, HasSubstr("analysis." + std::string(bad).substr(0, std::string(bad).find(' ')))) << bad;
  }
}

TEST_F(Study, AnEnsembleTellsItsStage) {
  write("study.toml", "scene = \"scene.toml\"\nseeds = 2\n[[row]]\nname = \"a\"\nstage = 1\n[[row]]\nname = \"b\"\n");
  ASSERT_EQ(run(study("out")).code, 0);
  const DataTable t = table("out/study.csv");
  ASSERT_EQ(t.columns[1].name, "stage");
  EXPECT_THAT(t.columns[1].text, ElementsAre("1", ""));
  EXPECT_EQ(at(t, "counts.z", 0), at(t, "counts.z", 1)) << "the last stage is where a run ends";
  EXPECT_TRUE(exists("out/a.stage1.report.json") && exists("out/b.report.json"));
  write("study.toml", "scene = \"scene.toml\"\nseeds = 2\n[[row]]\nname = \"a\"\nstages = [1, 2]\n");
  EXPECT_THAT(run(study("new")).err, HasSubstr("no such stage in a: the last is 1"));
}

TEST_F(Study, ItsTableIsPlotted) {
  write("study.toml", R"(scene = "scene.toml"
seeds = 2
[set]
grains.solid_fraction = 0.45
[[row]]
name = "rr"
[[row]]
name = "no"
law.rolling = false
[grid]
law.friction = [0.1, 0.3, 0.5]
)");
  ASSERT_EQ(run(study("out")).code, 0);
  const std::string plot = "plot " + in_folder("out/study.csv") + " -o " + in_folder("z.svg");
  ASSERT_EQ(run(plot + " --what study --x law.friction --y z").code, 0);
  const std::string svg = text("z.svg");
  for (const char* said : {"rolling = true", "rolling = false", ">μ<", "<tspan font-style=\"italic\">z</tspan>"})
    EXPECT_THAT(svg, HasSubstr(said));
  EXPECT_EQ(run(plot + " --x solid_fraction --y z").code, 2) << "which solid fraction";
  EXPECT_EQ(run(plot + " --x counts.solid_fraction --y z").code, 0);
  for (const char* bad : {"--what study", "--x law.friction", "--x row --y z", "--x law.friction --y zz",
                          "--what series --x law.friction --y z"})
    EXPECT_EQ(run(plot + " " + bad).code, 2) << bad;
}

// Stages as rows with their pressure; a derived column is the mean of the expression and not the expression of the
// means.
TEST_F(Study, DerivedColumnsAndSlopesOverStages) {
  write("path.toml", quick_scene(20) + R"toml([[stage]]
pressures = [0.2, 0.4]
max_strain_rate = 0.1
until = "time"
time = 1
)toml");
  write("study.toml", R"toml(scene = "path.toml"
seeds = 3
stages = "all"
[derived]
zeta = "counts.z"      # before those that need it, whatever the order of the alphabet
e = "1 / counts.solid_fraction - 1"
a = "2 * zeta ^ 2 - zeta"
[[slope]]
name = "lambda"
x = "log(stage.pressure)"
y = "e"
stages = [1, 2, 3]
)toml");
  const Outcome o = run(study("out"));
  ASSERT_EQ(o.code, 0) << o.err;
  const DataTable t = table("out/study.csv");
  ASSERT_EQ(t.rows(), 4u);
  EXPECT_THAT(t.find("stage.pressure")->text, ElementsAre("", "0.1", "0.2", "0.4"));
  const auto counts = [&](int seed, const std::string& stage) {
    return json::parse(text("out/path.000" + std::to_string(seed) + stage + ".analysis.json"))["report"]["counts"];
  };
  double mean_slope = 0;
  for (int seed = 1; seed <= 3; ++seed) {
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (const auto& [stage, pressure] :
         std::vector<std::pair<std::string, double>>{{".stage1", 0.1}, {".stage2", 0.2}, {".stage3", 0.4}}) {
      const double px = std::log(pressure), py = 1 / counts(seed, stage)["solid_fraction"].get<double>() - 1;
      ++n, x += px, y += py, xx += px * px, xy += px * py;
    }
    mean_slope += (n * xy - x * y) / (n * xx - x * x) / 3;
  }
  const DataTable slopes = table("out/slopes.csv");
  ASSERT_EQ(slopes.rows(), 1u);
  EXPECT_EQ(slopes.find("n")->value[0], 3);
  EXPECT_NEAR(slopes.find("mean")->value[0], mean_slope, 1e-10);
  for (std::size_t r = 0; r < 4; ++r) {
    std::vector<double> a;
    double mean = 0, squares = 0;
    for (int seed = 1; seed <= 3; ++seed) {
      const double z = counts(seed, ".stage" + std::to_string(r))["z"];
      a.push_back(2 * z * z - z), mean += a.back() / 3;
    }
    for (const double v : a) squares += (v - mean) * (v - mean);
    EXPECT_NEAR(at(t, "a", r), mean, 1e-12 * std::abs(mean));
    EXPECT_NEAR(at(t, "a_se", r), std::sqrt(squares / 2 / 3), 1e-9 * std::abs(mean));
  }
}

TEST_F(Study, FaultsOfDerivedColumns) {
  write("study.toml", R"toml(scene = "scene.toml"
seeds = 2
[derived]
a = "1 + "
b = "moduli.bulk"
c = "ln(counts.z)"
d = "counts.z / e"
e = 3
"f g" = "1"
[[slope]]
name = "s"
x = "counts.z"
stages = [0, 7]
colour = 1
)toml");
  const Outcome o = run(study("out"));
  EXPECT_EQ(o.code, 2);
  for (const char* fault :
       {"study.toml:4: derived.a", "something is missing", "study.toml:5: derived.b", "SECTION.KEY", "no function ln",
        "study.toml:7: derived.d", "study.toml:8: derived.e", "derived.f g", "slope.y", "slope.stages", "slope.colour"})
    EXPECT_THAT(o.err, HasSubstr(fault));
  EXPECT_FALSE(exists("out/study.csv"));
}

TEST_F(Study, CurvesOverTheSeriesAndTheirPeaks) {
  write("path.toml", quick_scene(20) + R"toml([[stage]]
strain_rate_1 = 0.05
stress_2 = 0.1
until = "strain"
strain = 0.03
)toml");
  write("study.toml", R"toml(scene = "path.toml"
seeds = 3
[set]
output.series = "s.csv"
output.series_interval = 0.01
[grid]
law.friction = [0.0, 0.5]
[[curve]]
name = "deviator"
x = "strain1"
y = "(sigma11 - sigma22) / 2"
step = 0.005
stage = 1
)toml");
  const Outcome o = run(study("out"));
  ASSERT_EQ(o.code, 0) << o.err;
  const DataTable curve = table("out/curve.deviator.csv"), peaks = table("out/peaks.csv");
  // Bin by bin from the series themselves.
  std::size_t row = 0;
  ASSERT_EQ(peaks.rows(), 2u);
  for (const std::string set : {"path-friction=0.0", "path-friction=0.5"}) {
    std::vector<std::map<int, std::pair<double, int>>> samples(3);
    std::vector<double> highest(3, -INFINITY);
    for (std::size_t k = 0; k < 3; ++k) {
      const DataTable s = table("out/" + set + ".000" + std::to_string(k + 1) + ".series.csv");
      for (std::size_t r = 0; r < s.rows(); ++r) {
        if (at(s, "stage", r) != 1) continue;
        auto& [sum, n] = samples[k][static_cast<int>(std::floor(at(s, "strain1", r) / 0.005))];
        sum += (at(s, "sigma11", r) - at(s, "sigma22", r)) / 2, ++n;
      }
      for (const auto& [bin, sum] : samples[k]) highest[k] = std::max(highest[k], sum.first / sum.second);
    }
    for (const auto& [bin, first] : samples[0]) {
      if (!samples[1].contains(bin) || !samples[2].contains(bin)) continue;
      double mean = 0, squares = 0;
      for (auto& sample : samples) mean += sample[bin].first / sample[bin].second / 3;
      for (auto& sample : samples) squares += std::pow(sample[bin].first / sample[bin].second - mean, 2);
      ASSERT_LT(row, curve.rows());
      EXPECT_EQ(curve.find("row")->text[row], set);
      EXPECT_NEAR(at(curve, "strain1", row), 0.005 * (bin + 0.5), 1e-12);
      EXPECT_NEAR(at(curve, "deviator", row), mean, 1e-12 * std::abs(mean));
      EXPECT_NEAR(at(curve, "deviator_se", row), std::sqrt(squares / 6), 1e-9 * std::abs(mean));
      ++row;
    }
    const std::size_t line = set == "path-friction=0.0" ? 0 : 1;
    EXPECT_EQ(peaks.find("curve")->text[line], "deviator");
    EXPECT_NEAR(at(peaks, "peak", line), (highest[0] + highest[1] + highest[2]) / 3, 1e-12);
  }
  EXPECT_EQ(row, curve.rows());
  EXPECT_GE(row, 12u);
  const Outcome plot = run("plot " + in_folder("out/curve.deviator.csv") + " -o " + in_folder("c.svg") +
                           " --what study --x strain1 --y deviator");
  EXPECT_EQ(plot.code, 0) << plot.err;
  EXPECT_THAT(text("c.svg"), HasSubstr("friction"));
}

TEST_F(Study, GrainsOfEachSampleFromTheStatesOfAnotherStudy) {
  write("study.toml", "scene = \"scene.toml\"\nseeds = 2\n");
  ASSERT_EQ(run(study("first")).code, 0);
  write("study.toml",
        "scene = \"scene.toml\"\nseeds = 2\nanalyze = [\"counts\"]\n[set]\nstage.0.pressure = 0.2\n"
        "grains.file = \"" +
            in_folder("first/scene.{seed}.h5") + "\"\n");
  const Outcome o = run(study("second"));
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_THAT(text("second/study.csv"), HasSubstr("scene.{seed}.h5"));
  for (int seed = 1; seed <= 2; ++seed) {
    const std::string name = "scene.000" + std::to_string(seed) + ".h5";
    const Outcome one =
        run("pack " + in_folder("scene.toml") + " --seed " + std::to_string(seed) + " --set 'grains.file=\"" +
            in_folder("first/" + name) + "\"' --set stage.0.pressure=0.2 -o " + in_folder("one.h5") + " --force");
    ASSERT_EQ(one.code, 0) << one.err;
    EXPECT_TRUE(text("one.h5") == text("second/" + name)) << seed;
  }
  const auto before = files("second");
  ASSERT_EQ(run(study("second")).code, 0);  // nothing is run again
  for (const auto& [name, file] : files("second")) {
    if (name.ends_with(".h5")) {
      EXPECT_EQ(file, before.at(name)) << name;
    }
  }
}

TEST_F(Study, FaultsOfCurves) {
  write("study.toml", R"toml(scene = "scene.toml"
seeds = 1
[[curve]]
name = "a"
x = "strain1 +"
y = "sigma11"
step = 0.0
stage = 4
)toml");
  const Outcome o = run(study("out"));
  EXPECT_EQ(o.code, 2);
  for (const char* fault : {"curve.x", "curve.step", "a real > 0 in the unit of x", "curve.stage", "output.series"})
    EXPECT_THAT(o.err, HasSubstr(fault));
  write("study.toml", R"toml(scene = "scene.toml"
seeds = 1
[set]
output.series = "s.csv"
[[curve]]
name = "a"
x = "strain1"
y = "sigma_11"
step = 0.1
stage = 0
)toml");
  const Outcome unknown = run(study("out"));
  EXPECT_EQ(unknown.code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("sigma_11"));
  EXPECT_THAT(unknown.err, HasSubstr("no such column"));
}

}  // namespace
}  // namespace isostat
