// Scene files: what is read is what was written, every fault is found, and the page of keys is the table of keys.
#include "dem/scene/file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "dem/disks/scales.hpp"
#include "dem/input_error.hpp"
#include "dem/scene/check.hpp"
#include "dem/scene/documentation.hpp"
#include "dem/scene/keys.hpp"
#include "dem/scene/suggestion.hpp"
#include "dem/scene/text.hpp"

namespace isostat {
namespace {

using ::testing::HasSubstr;

const std::string kStage = "[[stage]]\npressure = 0.01\n";

std::vector<Fault> faults_of(const std::string& text, const std::vector<std::string>& set = {}) {
  try {
    parse_scene(text, "scene.toml", set);
  } catch (const InputError& error) {
    return error.faults();
  }
  return {};
}

Fault only_fault(const std::string& text, const std::vector<std::string>& set = {}) {
  const std::vector<Fault> faults = faults_of(text, set);
  EXPECT_EQ(faults.size(), 1u) << text;
  return faults.empty() ? Fault{} : faults.front();
}

std::string slurp(const std::filesystem::path& path) {
  std::ifstream in(path);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

TEST(SceneFile, ReadsEveryKindOfValue) {
  const Scene s = parse_scene(
      "seed = 7\n[grains]\ncount = 12\nsolid_fraction = 0.25\n[law]\nrolling = false\nfriction = 1\n[finish]\n"
      "method = \"drag\"\ndrag = 0.25\n[output]\nseries = \"a \\\"b\\\".csv\"\nsnapshot_times = [1, 2.5]\n"
      "[[stage]]\nvelocity = 9.5\n[[stage]]\npressure = 0\nuntil = \"time\"\ntime = 30\n",
      "scene.toml");
  EXPECT_EQ(s.seed, 7u);
  EXPECT_EQ(s.grains.count, 12);
  EXPECT_EQ(s.grains.solid_fraction, 0.25);
  EXPECT_FALSE(s.law.rolling);
  EXPECT_EQ(s.law.friction, 1.0);  // an integer is accepted for a real
  EXPECT_EQ(s.finish.method, Finish::drag);
  EXPECT_EQ(s.output.series, "a \"b\".csv");
  EXPECT_EQ(s.output.snapshot_times, (std::vector<double>{1, 2.5}));
  ASSERT_EQ(s.stages.size(), 2u);
  EXPECT_FALSE(s.stages[0].pressure);
  EXPECT_EQ(s.stages[0].velocity, 9.5);
  EXPECT_EQ(s.stages[1].pressure, 0.0);
  EXPECT_EQ(s.stages[1].time, 30.0);
  EXPECT_FALSE(s.units);
}

TEST(SceneFile, OverridesReplaceTheFileAndEarlierOverrides) {
  const Scene s = parse_scene("[law]\nfriction = -3\n" + kStage, "scene.toml",
                              {"law.friction=0.1", "law.friction=0.2", "stage.0.until=\"time\"", "stage.0.time = 5",
                               "units.a=1e-6", "units.density=1", "units.F0=1e-9"});
  EXPECT_EQ(s.law.friction, 0.2);
  EXPECT_EQ(s.stages[0].until, Until::time);
  EXPECT_EQ(s.stages[0].time, 5.0);
  EXPECT_EQ(s.stages[0].pressure, 0.01);
  ASSERT_TRUE(s.units);
  EXPECT_EQ(s.units->force, 1e-9);
}

TEST(SceneFile, KeysThatDoNotApplyAreIgnored) {
  Scene expected;
  expected.law.rolling = false;
  expected.law.attraction = 0;
  expected.stages.resize(1);
  expected.stages[0].pressure = 1.0;
  EXPECT_EQ(parse_scene("[law]\nrolling = false\nrolling_friction = -1\nrolling_stiffness = nan\nattraction = 0\n"
                        "attraction_range = \"none\"\n[[stage]]\npressure = 1\n",
                        "scene.toml"),
            expected);
}

TEST(SceneFile, FaultNamesFileLineKeyValueAndRule) {
  const Fault f = only_fault("[law]\n\nfriction = -0.5\n" + kStage);
  EXPECT_EQ(f.file, "scene.toml");
  EXPECT_EQ(f.line, 3);
  EXPECT_EQ(f.key, "law.friction");
  EXPECT_EQ(f.value, "-0.5");
  EXPECT_EQ(f.rule, "real >= 0");
}

// Each fault by itself: text, key at fault, and a word of the rule.
struct Case {
  std::string text, key, rule;
  std::vector<std::string> set = {};
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.text << c.key; }

class SceneFault : public ::testing::TestWithParam<Case> {};

TEST_P(SceneFault, IsFoundAlone) {
  const Fault f = only_fault(GetParam().text, GetParam().set);
  EXPECT_EQ(f.key, GetParam().key);
  EXPECT_THAT(f.rule, HasSubstr(GetParam().rule));
}

INSTANTIATE_TEST_SUITE_P(
    Each, SceneFault,
    ::testing::Values(
        Case{"[grains\n", "", "not valid TOML"}, Case{"seed = 1\nseed = 2\n", "", "not valid TOML"},
        Case{"seed = -1\n" + kStage, "seed", ">= 0"},
        Case{"[grains]\ncount = 0\n" + kStage, "grains.count", "[1, 1e+09]"},
        Case{"[grains]\ncount = 10.5\n" + kStage, "grains.count", "integer"},
        Case{"[grains]\ncount = 9223372036854775807\n" + kStage, "grains.count", "integer"},
        Case{"[grains]\nsolid_fraction = 1.0\n" + kStage, "grains.solid_fraction", "(0, 1)"},
        Case{"[grains]\nsizes = \"gauss\"\n" + kStage, "grains.sizes", "lognormal"},
        Case{"[grains]\nsizes = \"power-law\"\n" + kStage, "grains.exponent", "is wanted"},
        Case{"[grains]\nsizes = \"table\"\n" + kStage, "grains.size_table", "CSV file"},
        Case{"[grains]\nsize_table = \"sizes.csv\"\n" + kStage, "grains.sizes", "\"table\""},
        Case{"[grains]\nsizes = \"bidisperse\"\nlarge_share = 1.5\n" + kStage, "grains.large_share", "[0, 1]"},
        Case{"[grains]\nsizes = \"bidisperse\"\ndensity_ratio = 0\n" + kStage, "grains.density_ratio", "> 0"},
        Case{"[grains]\nsizes = \"lognormal\"\nlog_deviation = -1\n" + kStage, "grains.log_deviation", "> 0"},
        Case{"[grains]\nsizes = \"lognormal\"\nmedian = 9\n" + kStage, "grains.median", "lies between"},
        Case{"[grains]\nshare_of = \"mass\"\n" + kStage, "grains.share_of", "\"volume\""},
        Case{"[grains]\nsize = \"table\"\n" + kStage, "grains.size", "did you mean grains.sizes?"},
        Case{"[grains]\nfile = \"x.csv\"\nbox = [1.0, 0.0]\n" + kStage, "grains.box", "> 0"},
        Case{"system = \"spheres\"\n[grains]\nsizes = \"lognormal\"\narrangement = \"insertion\"\n" + kStage,
             "grains.sizes", "power-law"},
        Case{"[grains]\ndiameter_min = 1.5\n" + kStage, "grains.diameter_min", "at most grains.diameter_max = 1.0"},
        Case{"[grains]\ndiameter_max = \"big\"\n" + kStage, "grains.diameter_max", "real"},
        Case{"[law]\nfriction = nan\n" + kStage, "law.friction", "real >= 0"},
        Case{"[law]\nnormal_stiffness = inf\n" + kStage, "law.normal_stiffness", "> 0"},
        Case{"[law]\nnormal_stiffness = 5\n" + kStage, "law.normal_stiffness", "too soft"},
        Case{"[law]\nnormal_stiffness = 1e14\n" + kStage, "law.normal_stiffness", "too stiff"},
        Case{"[[stage]]\npressure = 1e5\n", "law.normal_stiffness", "too soft"},
        Case{"[law]\ndamping = 1.5\n" + kStage, "law.damping", "[0, 1]"},
        Case{"[law]\nrolling = 1\n" + kStage, "law.rolling", "boolean"},
        Case{"[law]\nrolling_friction = -1\n" + kStage, "law.rolling_friction", ">= 0"},
        Case{"[law]\nattraction_range = 0\n" + kStage, "law.attraction_range", "> 0"},
        Case{"[step]\nfraction = 0.3\n" + kStage, "step.fraction", "unstable"},
        Case{"[step]\nfraction = 0\n" + kStage, "step.fraction", ">= 1e-06"},
        Case{"[finish]\nmethod = \"magic\"\n" + kStage, "finish.method", "one of \"none\" \"drag\""},
        Case{"[law]\nfrictoin = 1\n" + kStage, "law.frictoin", "did you mean law.friction?"},
        Case{"[laww]\nfriction = 1\n" + kStage, "laww.friction", "did you mean law.friction?"},
        Case{"friction = 1\n" + kStage, "friction", "did you mean law.friction?"},
        Case{"\"law.friction\" = 1\n" + kStage, "\"law.friction\"", "unknown key"},
        Case{"[graims]\n" + kStage, "graims", "did you mean grains?"}, Case{"law = 3\n" + kStage, "law", "write [law]"},
        Case{"[stage]\npressure = 1\n", "stage", "[[stage]]"}, Case{"seed = 1\n", "stage", "at least one"},
        Case{"[[stage]]\npressure = -0.1\n", "stage.0.pressure", ">= 0"},
        Case{"[[stage]]\n[[stage]]\npresure = 0\n", "stage.1.presure", "did you mean stage.1.pressure?"},
        Case{"[[stage]]\nuntil = \"time\"\n", "stage.0.time", "greater than 0"},
        Case{"[[stage]]\ntime = 10\n", "stage.0.time", "only with stage.0.until"},
        Case{"[[stage]]\nuntil = \"soon\"\n", "stage.0.until", "one of"},
        Case{"[law]\nattraction = 0\n[[stage]]\npressure = 0\n", "stage.0.pressure", "no force scale"},
        Case{"[output]\nsnapshot_times = [1, -1]\n" + kStage, "output.snapshot_times", "list of reals >= 0"},
        Case{"[output]\nsnapshot_times = 3\n" + kStage, "output.snapshot_times", "list of reals"},
        Case{"[units]\na = 1e-6\nF0 = 1e-9\n" + kStage, "units.density", "all of its keys"},
        Case{kStage, "law.frict", "law.friction", {"law.frict=1"}},
        Case{kStage, "law.friction", "not a TOML value", {"law.friction=abc"}},
        Case{kStage, "law.friction", "not a TOML value", {"law.friction=1\nseed=2"}},
        Case{kStage, "", "KEY=VALUE", {"law.friction"}}, Case{kStage, "law", "single value", {"law={friction=1}"}},
        Case{kStage, "stage.3.pressure", "the scene has 1", {"stage.3.pressure=1"}},
        Case{kStage, "stage.x.pressure", "unknown key", {"stage.x.pressure=1"}}));

TEST(SceneFile, ListsAllFaultsAtOnceInOrderOfLines) {
  const std::vector<Fault> faults = faults_of(
      "[grains]\ncount = 0\ndiameter_min = 2\n[law]\nfrictoin = 1\nfriction = nan\n[step]\nfraction = 3\n"
      "[[stage]]\npressure = -1\nuntil = \"never\"\n",
      {"law.damping=7"});
  std::vector<std::string> keys;
  for (const Fault& f : faults) keys.push_back(f.key);
  // step.fraction also breaks the stability bound, but that rule involves law.friction, which is at fault itself
  EXPECT_EQ(keys, (std::vector<std::string>{"grains.count", "grains.diameter_min", "law.frictoin", "law.friction",
                                            "stage.0.pressure", "stage.0.until", "law.damping"}));
}

TEST(SceneFile, MissingFileAndDirectoryAreBadInput) {
  EXPECT_THROW(read_scene("/nonexistent/scene.toml"), InputError);
  EXPECT_THROW(read_scene("/tmp"), InputError);
}

TEST(SceneFile, ShippedScenes) {
  const Scene cohesive = read_scene(ISOSTAT_DATA "/scenes/disks-method1.toml");
  EXPECT_EQ(cohesive.grains.count, 1400);
  EXPECT_EQ(cohesive.law.friction, 0.5);
  EXPECT_EQ(cohesive.stages.size(), 1u);
  const Scene dry = read_scene(ISOSTAT_DATA "/scenes/disks-method1-cohesionless.toml");
  EXPECT_EQ(resolve(dry.law).attraction, 0.0);
  EXPECT_EQ(dry.stages.at(0).pressure, 1.0);
}

// A random scene that obeys the rules of single keys, written through the table.
Scene random_scene(SceneSystem system) {
  Scene scene = default_scene(system, *rc::gen::inRange<std::size_t>(1, 4));
  if (system == SceneSystem::disks && *rc::gen::arbitrary<bool>()) scene.units.emplace();
  const auto real = [](const SceneRange& range) {
    const double unit = *rc::gen::inRange(1, 1000000) / 1e6;
    if (std::isfinite(range.high)) return range.low + (range.high - range.low) * unit;
    return std::isfinite(range.low) ? range.low + std::pow(10.0, *rc::gen::inRange(-8, 9)) * unit : unit;
  };
  for (const SceneKey& key : scene_keys(system)) {
    if (key.name == "system") continue;
    for (std::size_t stage = 0; stage < (belongs_to_stage(key) ? scene.stages.size() : 1); ++stage) {
      if (!applies(key, scene)) continue;
      std::visit(
          [&](auto* value) {
            using T = std::remove_cvref_t<decltype(*value)>;
            if constexpr (std::is_same_v<T, bool>)
              *value = *rc::gen::arbitrary<bool>();
            else if constexpr (std::is_integral_v<T>)
              *value = static_cast<T>(*rc::gen::inRange(1, 1000000000));
            else if constexpr (std::is_same_v<T, std::optional<double>>)
              *value = *rc::gen::arbitrary<bool>() ? std::optional<double>(real(key.range)) : std::nullopt;
            else if constexpr (std::is_same_v<T, double>)
              *value = real(key.range);
            else if constexpr (std::is_same_v<T, std::vector<double>>)
              value->assign(*rc::gen::inRange<std::size_t>(0, 4), real(key.range));
            else if constexpr (std::is_same_v<T, std::string>)
              *value = key.choices.empty() ? *rc::gen::container<std::string>(rc::gen::inRange<char>(1, 127))
                                           : std::string(*rc::gen::elementOf(key.choices));
            else
              *value = static_cast<T>(*rc::gen::inRange<std::size_t>(0, key.choices.size()));
          },
          key.field(scene, stage));
    }
  }
  return scene;
}

// A key that does not apply is not echoed, so what it held does not come back.
Scene without_ignored(Scene scene) {
  Scene plain = default_scene(scene.system, scene.stages.size());
  plain.units = scene.units;
  for (const SceneKey& key : scene_keys(scene.system))
    if (key.condition.holds && !applies(key, scene))
      std::visit([&](auto* value) { *value = *std::get<decltype(value)>(key.field(plain, 0)); }, key.field(scene, 0));
  return scene;
}

RC_GTEST_PROP(SceneFile, EchoParsesBackToAnEqualScene, ()) {
  const Scene scene = without_ignored(random_scene(*rc::gen::element(SceneSystem::disks, SceneSystem::triangles)));
  const std::string text = scene_to_toml(scene);
  const Scene back = parse_scene(text, "echo", {}, SceneChecks::keys);
  RC_ASSERT(back == scene);
  RC_ASSERT(scene_to_toml(back) == text);
}

RC_GTEST_PROP(SceneFile, AnyTextIsASceneOrBadInput, ()) {
  std::string text = slurp(*rc::gen::element(std::string(ISOSTAT_DATA "/scenes/disks-method1.toml"),
                                             std::string(ISOSTAT_DATA "/scenes/hopper.toml")));
  const int edits = *rc::gen::inRange(1, 8);
  for (int k = 0; k < edits; ++k) text[*rc::gen::inRange<std::size_t>(0, text.size())] = *rc::gen::arbitrary<char>();
  try {
    parse_scene(text, "scene.toml");
  } catch (const InputError& error) {
    RC_ASSERT(!error.faults().empty());
  }
}

// Uniform spin of equal disks on a triangular lattice, K_N = K_T, no rolling springs: energy per disk of 3 contacts
// 3 K_T (2 R w)^2 / 2 against inertia m R^2 / 2: omega^2 = 24 K_T / m.
TEST(Scales, CriticalStepIsThatOfTheTriangularLattice) {
  DiskLaw law;
  law.normal_stiffness = law.tangential_stiffness = 1e5;
  const double omega = std::sqrt(24 * 1e5 / (0.5 * 0.5));
  EXPECT_NEAR(critical_time_step(law, 0.5), 2 / omega, 1e-15);
}

TEST(Scales, OfTheShippedScene) {
  const Scene scene = read_scene(ISOSTAT_DATA "/scenes/disks-method1.toml");
  const DiskLaw law = resolve(scene.law);
  const double dt = time_step(law, *scene.step.fraction, 1.0);
  EXPECT_DOUBLE_EQ(dt, 0.12 * std::sqrt(1e-5));
  const Scales s = scales(law, 0.01, 0.5, dt);
  EXPECT_DOUBLE_EQ(*s.kappa, 1e5);
  EXPECT_DOUBLE_EQ(*s.reduced_pressure, 0.01);
  EXPECT_DOUBLE_EQ(*s.overlap_over_range, 0.01);
  EXPECT_DOUBLE_EQ(*s.velocity, std::sqrt(1e-3));
  EXPECT_DOUBLE_EQ(*s.time, 1.0);
  EXPECT_NEAR(s.restitution, 0.0151646, 1e-7);  // exp(-4 pi / 3)
  DiskLaw dry = law;
  dry.attraction = dry.attraction_range = 0;
  const Scales t = scales(dry, 4.0, 0.5, dt);
  EXPECT_DOUBLE_EQ(*t.kappa, 1e5 / 4);
  EXPECT_DOUBLE_EQ(*t.time, 0.5);
  EXPECT_FALSE(t.velocity || t.overlap_over_range);
}

TEST(Suggestion, NearestName) {
  const std::vector<std::string> names{"law.friction", "law.rolling", "grains.count"};
  EXPECT_EQ(nearest_name("law.firction", names), "law.friction");
  EXPECT_EQ(nearest_name("count", names), "grains.count");
  EXPECT_EQ(nearest_name("temperature", names), "");
  EXPECT_EQ(nearest_name(std::string(100000, 'x'), names), "");
}

TEST(SceneDocumentation, IsTheTable) {
  const std::filesystem::path page = std::filesystem::path(ISOSTAT_DATA).parent_path() / "docs/scene.md";
  if (std::getenv("ISOSTAT_REGENERATE")) std::ofstream(page) << scene_documentation();
  EXPECT_EQ(slurp(page), scene_documentation()) << "run the tests with ISOSTAT_REGENERATE=1";
}

TEST(SceneDocumentation, EveryRowOfATableHasTheCellsOfItsHeading) {
  std::istringstream page(scene_documentation());
  int rows = 0, heading = 0;
  for (std::string line; std::getline(page, line);) {
    int bars = 0;
    for (std::size_t k = 0; k < line.size(); ++k) bars += line[k] == '|' && (k == 0 || line[k - 1] != '\\');
    const int cells = line.starts_with('|') ? bars - 1 : 0;
    if (cells == 0 || heading == 0) heading = cells;
    if (cells == 0) continue;
    EXPECT_EQ(cells, heading) << line;
    rows += cells == 5;
  }
  EXPECT_GT(rows, 40);
}

}  // namespace
}  // namespace isostat
