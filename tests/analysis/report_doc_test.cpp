// docs/report.md and the code say the same: every key of the network sections is documented, every documented key
// exists.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "analysis/load_input.hpp"
#include "analysis/report.hpp"
#include "dem/input_error.hpp"
#include "tests/oracle/network_oracle.hpp"
#include "tests/support/refusal.hpp"

namespace isostat {
namespace {

using Json = nlohmann::ordered_json;

std::set<std::string> documented_keys(const std::string& section) {
  std::ifstream file(std::string(ISOSTAT_DATA) + "/../docs/report.md");
  std::set<std::string> keys;
  const std::regex row("^\\| `(" + section + "\\.[A-Za-z0-9_.]+)` \\|.*");
  std::smatch match;
  for (std::string line; std::getline(file, line);)
    if (std::regex_match(line, match, row)) keys.insert(match[1]);
  return keys;
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
  input.state.imposed_stress = isotropic(0.01);
  return input;
}

TEST(ReportDoc, EveryKeyOfTheNetworkSectionsIsDocumentedAndExists) {
  const Json report = analyze(cohesive_state(), {}, {"counts", "equilibrium", "stress", "forces", "percolation"});
  for (const char* section : {"counts", "equilibrium", "stress", "forces", "percolation"}) {
    std::set<std::string> keys;
    collect(report.at(section), section, keys);
    EXPECT_EQ(keys, documented_keys(section)) << section;
  }
}

TEST(ReportDoc, EverySectionHasItsHeadingOrSaysWhereItsKeysAre) {
  std::ifstream file(std::string(ISOSTAT_DATA) + "/../docs/report.md");
  std::stringstream text;
  text << file.rdbuf();
  for (const Section& s : sections()) {
    const std::string name(s.name), all = text.str();
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
}

TEST(Report, SkipsWhatDoesNotApplyUnlessNamed) {
  AnalysisInput input = cohesive_state();
  input.state.law = {};
  const Json report = analyze(input, {}, {});
  EXPECT_TRUE(report.contains("counts"));
  EXPECT_FALSE(report.contains("equilibrium"));
  EXPECT_THROW(analyze(input, {}, {"equilibrium"}), InputError);
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

}  // namespace
}  // namespace isostat
