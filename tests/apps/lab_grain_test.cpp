// isostat lab grain: the JSON of the contract, and one clear message for each bad input.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/apps/program.hpp"

namespace isostat {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;
using LabGrain = Program;

TEST_F(LabGrain, PrintsTheContract) {
  const Outcome o = run("lab grain --shape square --size 0.1");
  ASSERT_EQ(o.code, 0) << o.err;
  const Json grain = Json::parse(o.out);
  EXPECT_EQ(grain.at("triangles"), 4);
  EXPECT_EQ(grain.at("beams"), 4);
  EXPECT_NEAR(grain.at("mass"), 0.01, 1e-16);
  EXPECT_NEAR(grain.at("inertia"), 0.01 * 0.01 / 6, 1e-19);
  const auto omega = grain.at("omega").get<std::vector<double>>();
  ASSERT_EQ(omega.size(), 12u);
  EXPECT_EQ(omega[2], 0);
  EXPECT_NEAR(omega.back(), 52433.1, 0.1);
  EXPECT_NEAR(double(grain.at("dt_max").at("gear")) * omega.back(), 0.3407, 1e-3);
  EXPECT_NEAR(double(grain.at("dt_max").at("verlet")) * omega.back(), 1.2371, 1e-3);
}

// omega scales as sqrt(stiffness/mass), whatever the option that changes it; without dampers Verlet's step is 2/omega.
TEST_F(LabGrain, TakesTheMaterial) {
  const Json plain = Json::parse(run("lab grain --shape L").out);
  ASSERT_EQ(run("lab grain --shape L --stiffness 4e5 --bending 40 --density 0.25 --damping 0 --json " +
                in_folder("grain.json"))
                .code,
            0);
  const Json changed = Json::parse(content(in_folder("grain.json")));
  EXPECT_NEAR(double(changed.at("mass")) / double(plain.at("mass")), 0.25, 1e-14);
  for (std::size_t k = 3; k < plain.at("omega").size(); ++k)
    EXPECT_NEAR(double(changed.at("omega")[k]) / double(plain.at("omega")[k]), 4, 1e-12);
  EXPECT_NEAR(double(changed.at("dt_max").at("verlet")) * double(changed.at("omega").back()), 2, 1e-5);
}

TEST_F(LabGrain, ReadsAFileAndRefinesIt) {
  const std::string cross = "lab grain --shape " ISOSTAT_DATA "/grains/cross.txt";
  const Json coarse = Json::parse(run(cross).out), fine = Json::parse(run(cross + " --refine 0.05").out);
  EXPECT_EQ(coarse.at("triangles"), 10);
  EXPECT_EQ(coarse.at("beams"), 9);
  EXPECT_GT(fine.at("triangles"), 10);
  EXPECT_NEAR(double(coarse.at("mass")), 5 * 0.04 * 0.04, 1e-15);
  EXPECT_NEAR(double(fine.at("inertia")) / double(coarse.at("inertia")), 1, 1e-12);
}

TEST_F(LabGrain, WithoutBeamsAnyStepIsStable) {
  const Json grain = Json::parse(run("lab grain --shape triangle").out);
  EXPECT_EQ(grain.at("omega"), Json::array({0.0, 0.0, 0.0}));
  EXPECT_TRUE(grain.at("dt_max").at("verlet").is_null());
}

TEST_F(LabGrain, RefusesBadInput) {
  const auto refused = [&](const std::string& arguments, const std::string& reason) {
    const Outcome o = run("lab grain " + arguments + " --json " + in_folder("none.json"));
    EXPECT_EQ(o.code, 2) << arguments;
    EXPECT_THAT(o.err, HasSubstr(reason)) << arguments;
    EXPECT_FALSE(exists("none.json")) << arguments;
  };
  write("bow.txt", "0 0\n1 1\n1 0\n0 1\n");
  write("line.txt", "0 0\n1 1\n2 2\n");
  write("closed.txt", "0 0\n1 0\n1 1\n0 0\n");
  refused("", "--shape");
  refused("square", "--shape NAME or FILE");
  refused("--shape sqare", "command line: --shape = sqare: neither a shape nor a file; did you mean square?");
  refused("--shape " + in_folder("bow.txt"), "bow.txt:1: corner = 1: the polygon intersects itself");
  refused("--shape " + in_folder("line.txt"), "all corners lie on one line: the polygon has no area");
  refused("--shape " + in_folder("closed.txt"), "corners 1 and 4 are the same point");
  refused("--shape " + in_folder("missing.txt"), "missing.txt");
  refused("--shape square --size 0", "--size = 0.0: positive");
  refused("--shape square --size x", "--size");
  refused("--shape square --bending 0 --density -1", "--bending = 0.0: positive");
  refused("--shape square --bending 0 --density -1", "--density = -1.0: positive");
  refused("--shape square --damping -1", "--damping = -1.0: not negative");
  refused("--shape square --refine 0.1", "only the polygon of a file");
  refused("--shape " ISOSTAT_DATA "/grains/cross.txt --refine 0.008", "at most 100");
}

}  // namespace
}  // namespace isostat
