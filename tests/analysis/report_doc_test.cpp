// The pages and the code say the same: every key of every section is documented, in docs/report.md or in the page that
// it names for the section; every key that docs/report.md documents exists.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "analysis/load_input.hpp"
#include "analysis/report.hpp"
#include "analysis/report_units.hpp"
#include "dem/files/atomic_file.hpp"
#include "dem/files/packing_file.hpp"
#include "dem/input_error.hpp"
#include "dem/triangles/network_file.hpp"
#include "tests/oracle/network_oracle.hpp"
#include "tests/support/refusal.hpp"

namespace isostat {
namespace {

using Json = nlohmann::ordered_json;

std::string page(const std::string& name) { return read_whole_file(std::string(ISOSTAT_DATA) + "/../docs/" + name); }

// First cells of the tables of docs/report.md, `SECTION.KEY`.
std::set<std::string> documented_keys(const std::string& section) {
  std::istringstream text(page("report.md"));
  std::set<std::string> keys;
  const std::regex row("^\\| `(" + section + "\\.[A-Za-z0-9_.]+)` \\|.*");
  std::smatch match;
  for (std::string line; std::getline(text, line);)
    if (std::regex_match(line, match, row)) keys.insert(match[1]);
  return keys;
}

// The page of the table "The other sections", or none.
std::string page_of(const std::string& section) {
  std::smatch match;
  const std::string text = page("report.md");
  const std::regex row("\n\\| `" + section + "` \\|[^|\n]*\\| docs/([a-z]+\\.md) \\|");
  return std::regex_search(text, match, row) ? match[1].str() : "";
}

// Everything in code marks on a page: `key`, `object.key`, `.key`.
std::set<std::string> names_on(const std::string& name) {
  const std::string text = page(name);
  const std::regex code("`([A-Za-z0-9_.]+)`");
  std::set<std::string> names;
  for (auto at = std::sregex_iterator(text.begin(), text.end(), code); at != std::sregex_iterator(); ++at)
    names.insert((*at)[1]);
  return names;
}

// Keys down to the first value that is no object; histograms count as one.
void collect(const Json& value, const std::string& prefix, std::set<std::string>& keys) {
  for (const auto& [key, member] : value.items())
    if (member.is_object() && key != "histograms")
      collect(member, prefix + "." + key, keys);
    else
      keys.insert(prefix + "." + key);
}

AnalysisInput cohesive_state() {
  AnalysisInput input;
  input.path = "test";
  Packing<2>& packing = input.state.packing;
  packing = oracle::random_packing(1, 20, 60, true);
  for (std::size_t l = 0; l < packing.links.size(); l += 7) packing.links[l].kind = LinkKind::distant;
  input.links_given = true;
  input.state.law.normal_stiffness = 1e5;
  input.state.law.friction = 0.5;
  input.state.law.attraction = 1;
  input.state.law.attraction_range = 1e-3;
  input.state.imposed_stress = isotropic<2>(0.01);
  return input;
}

// Two squares of a network.
AnalysisInput squares() {
  std::string text;
  for (int g = 0; g < 2; ++g) {
    const double x = 0.9 * g;
    const double corner[4][2] = {{x - .5, -.5}, {x + .5, -.5}, {x + .5, .5}, {x - .5, .5}};
    for (int t = 0; t < 4; ++t) {
      text += "triangle " + std::to_string(4 * g + t) + " " + std::to_string(g);
      for (const double v : {corner[t][0], corner[t][1], corner[(t + 1) % 4][0], corner[(t + 1) % 4][1], x, 0.0})
        text += " " + std::to_string(v);
      text += "\n";
    }
    for (int t = 0; t < 4; ++t)
      text += "beam " + std::to_string(4 * g + t) + " " + std::to_string(4 * g + (t + 1) % 4) + "\n";
  }
  TriangleNetworkFile file = parse_triangle_network(text, "squares.net");
  AnalysisInput input;
  input.path = "squares.net";
  input.set_triangles(foreign_state(std::move(file.packing)), file.triangles);
  return input;
}

// Sections whose keys are in docs/report.md itself.
const std::vector<std::string> kHere{"counts",      "equilibrium", "stress",       "forces",
                                     "percolation", "stressed",    "two_contacts", "loops"};

TEST(ReportDoc, EveryKeyOfTheNetworkSectionsIsDocumentedAndExists) {
  std::set<std::string> of_beams;
  collect(analyze(squares(), {}, {"beams"}).at("beams"), "beams", of_beams);
  EXPECT_EQ(of_beams, documented_keys("beams"));
  EXPECT_EQ(oracle::refusal(cohesive_state(), "beams"), "needs grains of triangles joined by beams");
  const Json report = analyze(cohesive_state(), {}, kHere);
  for (const std::string& section : kHere) {
    std::set<std::string> keys;
    collect(report.at(section), section, keys);
    EXPECT_EQ(keys, documented_keys(section)) << section;
  }
}

// Of a key a.b.c the page may say `a.b.c`, `b.c`, `.c` or `c`.
bool is_named(const std::string& key, const std::set<std::string>& names) {
  for (std::size_t dot = 0; dot != std::string::npos; dot = key.find('.', dot + 1))
    if (names.contains(key.substr(dot)) || names.contains(key.substr(key[dot] == '.' ? dot + 1 : dot))) return true;
  return false;
}

TEST(ReportDoc, EveryKeyOfEverySectionIsOnItsPage) {
  AnalysisInput input = cohesive_state();
  for (double& mass : input.state.packing.bodies.mass) mass = 1;
  for (double& inertia : input.state.packing.bodies.inertia) inertia = 0.125;
  input.state.law.tangential_stiffness = 1e5;
  AnalysisOptions options;
  options.prestress = options.near_null = true;
  options.density = DensityOptions{.bins = 10};
  std::vector<std::string> all;
  for (const Section& s : sections())
    if (!s.takes.beams && s.takes.plane) all.emplace_back(s.name);
  const Json report = analyze(input, options, all);
  for (const std::string& section : all) {
    const std::string of_section = page_of(section);
    if (of_section.empty()) continue;  // in docs/report.md itself: the test before
    const std::set<std::string> names = names_on(of_section), here = documented_keys(section);
    std::set<std::string> keys;
    collect(report.at(section), section, keys);
    EXPECT_GT(keys.size(), 1u) << section;
    for (const std::string& key : keys)
      EXPECT_TRUE(here.contains(key) || is_named(key.substr(section.size() + 1), names))
          << key << ": not in docs/" << of_section;
    for (const std::string& key : here) EXPECT_TRUE(keys.contains(key)) << key << ": documented, not there";
  }
}

TEST(ReportDoc, EverySectionHasItsHeadingOrSaysWhereItsKeysAre) {
  for (const Section& s : sections()) {
    const std::string name(s.name), all = page("report.md");
    EXPECT_TRUE(all.find("\n## " + name + "\n") != std::string::npos ||
                all.find("\n| `" + name + "` |") != std::string::npos)
        << name;
  }
}

TEST(ReportDoc, HistogramsAreThoseNamed) {
  const Json report = analyze(cohesive_state(), {}, {"forces"});
  std::set<std::string> names;
  for (const auto& [name, unused] : report["forces"]["histograms"].items()) names.insert(name);
  EXPECT_EQ(names, (std::set<std::string>{"N", "N_over_mean", "F", "angle", "NT"}));
}

TEST(Report, ComputesOnlyWhatIsAskedFor) {
  const Json report = analyze(cohesive_state(), {}, {"stress"});
  EXPECT_TRUE(report.contains("stress"));
  EXPECT_FALSE(report.contains("counts"));
  EXPECT_EQ(report["inputs"], Json::array({"test"}));
}

TEST(Report, LeavesOutCostlySectionsUnlessNamed) {
  const AnalysisInput input = load_input(std::string(ISOSTAT_DATA) + "/clusters/triangle.net", {});
  const Json report = analyze(input, {}, {});
  EXPECT_TRUE(report.contains("stiffness"));
  EXPECT_FALSE(report.contains("modes"));
  EXPECT_EQ(analyze(input, {}, {"modes"})["modes"]["omega"].size(), 6u);
  AnalysisOptions prestress;
  prestress.prestress = true;
  EXPECT_EQ(oracle::refusal(input, "modes", prestress), "--prestress needs the forces of the links");
  AnalysisInput without_law = cohesive_state();
  without_law.state.law = {};
  EXPECT_EQ(oracle::refusal(without_law, "modes", prestress),
            "--prestress needs the stiffness of the contacts in the units of their forces: --stiffness");
}

TEST(Report, SkipsWhatDoesNotApplyUnlessNamed) {
  AnalysisInput input = cohesive_state();
  input.state.law = {};
  const Json report = analyze(input, {}, {});
  EXPECT_TRUE(report.contains("counts"));
  EXPECT_FALSE(report.contains("rdf"));
  EXPECT_THROW(analyze(input, {}, {"rdf"}), InputError);
}

TEST(Report, UnknownSectionsAreListedTogether) {
  try {
    parse_section_names("counts,floppy,stres");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.faults().size(), 2u);
  }
  EXPECT_EQ(parse_section_names("forces,counts,forces"), (std::vector<std::string>{"forces", "counts"}));
}

TEST(Report, KnowsTheLawOfAState) {
  AnalysisInput input = cohesive_state();
  EXPECT_EQ(input.network_law({}), NetworkLaw::friction);
  input.state.law.rolling_friction = 0.005;
  EXPECT_EQ(input.network_law({}), NetworkLaw::rolling);
  input.state.law.friction = input.state.law.rolling_friction = 0;
  EXPECT_EQ(input.network_law({}), NetworkLaw::frictionless);
  AnalysisOptions options;
  options.law = NetworkLaw::rolling;
  EXPECT_EQ(input.network_law(options), NetworkLaw::rolling);
  input.state.law = {};
  EXPECT_EQ(input.network_law({}), NetworkLaw::friction);
}

// The text report's units are those of the page: of a cohesive state, of beams in cgs.
TEST(ReportDoc, UnitsAreThoseOfThePage) {
  const Json reduced{{"system", "reduced"}, {"length", "a"}, {"force", "F0"}, {"pressure", "F0/a"}, {"time", "T0"}};
  const Json cgs{{"system", "cgs"}, {"length", "cm"}, {"force", "dyn"}, {"pressure", "dyn/cm"}, {"time", "s"}};
  std::istringstream text(page("report.md"));
  const std::regex row(R"(^\| `([a-z]+\.[A-Za-z0-9_.]+)` \|.*\| ([^|]*) \|$)");
  std::smatch match;
  std::size_t with_unit = 0;
  for (std::string line; std::getline(text, line);) {
    if (!std::regex_match(line, match, row)) continue;
    const std::string key = match[1], told = match[2];
    if (told.starts_with("as ") || told.empty() || told.find("](") != std::string::npos) continue;
    EXPECT_EQ(unit_of(key, key.starts_with("beams") ? cgs : reduced), told == "-" ? "" : told) << key;
    with_unit += told != "-";
  }
  EXPECT_GE(with_unit, 35u);
  EXPECT_EQ(unit_of("stress.pressure", Json{{"system", "of the input file"}}), "");
}

}  // namespace
}  // namespace isostat
