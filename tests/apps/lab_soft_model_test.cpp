// isostat lab soft-laws and soft-packing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/apps/program.hpp"

namespace isostat {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

class SoftModel : public Program {};

TEST_F(SoftModel, MeasuresLawsAndUsesThem) {
  const std::string laws = in_folder("laws.json");
  const Outcome measured = run("lab soft-laws --levels 2 --ratio 6 --packings 2 --json " + laws);
  ASSERT_EQ(measured.code, 0) << measured.err;
  const json l = json::parse(content(laws));
  ASSERT_EQ(l["levels"].size(), 2u);
  for (const json& level : l["levels"]) {
    for (const char* partner : {"soft_solid", "soft_soft"}) {
      EXPECT_GT(level[partner]["force"], 0);
      EXPECT_GT(level[partner]["exponent"], 1);
      EXPECT_GT(level[partner]["friction"], 0);
    }
    EXPECT_GT(level["wall"].back()["F"], level["wall"].front()["F"]);
    EXPECT_GT(level["wall"].back()["F"], level["soft"].back()["F"]);  // two soft-particles share the deformation
    for (const json& ball : level["balls"]) EXPECT_LT(ball["share"], 1.2);
  }
  EXPECT_EQ(l["levels"][0]["soft_particles"], 0);
  EXPECT_GT(l["levels"][1]["soft_particles"], 0);

  const std::string pressed = "lab soft-packing --laws " + laws + " --packings 2 --edge 1.3 --strain 0.12 --points 2 " +
                              "--increment 0.02 --iterations 200 --loads " + in_folder("loads.csv");
  const Outcome o = run(pressed);
  ASSERT_EQ(o.code, 0) << o.err;
  const json j = json::parse(o.out);
  EXPECT_GT(j["shells"]["bodies"], 3 * j["model"]["bodies"].get<double>());
  EXPECT_EQ(j["shells"]["solid_grains"], j["model"]["solid_grains"]);
  ASSERT_EQ(j["model_against_shells"].size(), 2u);
  EXPECT_EQ(j["model_against_shells"][1]["pressure"]["mean"], j["model"]["curve"][1]["pressure"]);
  EXPECT_EQ(j["model_against_shells"][1]["pressure"]["resolved"], j["shells"]["curve"][1]["pressure"]);
  const std::string loads = content(in_folder("loads.csv"));
  EXPECT_THAT(loads, HasSubstr("resolution,seed,strain,grain,load"));
  const double solids = j["model"]["solid_grains"];
  EXPECT_EQ(std::count(loads.begin(), loads.end(), '\n'), 1 + static_cast<long>(2 * 2 * 2 * solids));
}

TEST_F(SoftModel, RefusesWhatCannotBe) {
  write("no.json", "{\"levels\": []}");
  const auto refused = [&](const std::string& arguments, const std::string& words) {
    const Outcome o = run("lab " + arguments);
    EXPECT_EQ(o.code, 2) << arguments;
    EXPECT_THAT(o.err, HasSubstr(words));
  };
  refused("soft-laws --levels 0", "--levels = 0");
  refused("soft-laws --packings 1", "--packings = 1");
  refused("soft-laws --ratio 1", "--ratio = 1: from 2 to 30");
  refused("soft-packing", "--laws");
  refused("soft-packing --laws " + in_folder("none.json"), "cannot be read");
  refused("soft-packing --laws " + in_folder("no.json"), "no JSON of `isostat lab soft-laws`");
  refused("soft-particle --delta 0.1 --partner wall --partner-radius 0.01", "of --partner ball alone");
  refused("soft-particle --delta 0.1 --partner ball --partner-radius 0", "greater than 0");
}

}  // namespace
}  // namespace isostat
