// isostat lab collide-squares and lab throughput on triangles: PHYSICS's numbers, and what they refuse.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/apps/program.hpp"

namespace isostat {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;
using LabCollideSquares = Program;
using LabThroughput = Program;

// Poeschel and Buchholtz 1995, Sec. 6.1, by an independent program; +-.003 absolute.
TEST_F(LabCollideSquares, GivesTheTableOfSection61) {
  struct Row {
    double speed, translation, rotation, spin;
  };
  for (const Row& r : {Row{10, 0.679, 0.016, -0.218}, Row{50, 0.657, 0.013, -0.199}, Row{70, 0.619, 0.034, -0.321},
                       Row{100, 0.532, 0.151, -0.671}, Row{120, 0.524, 0.152, -0.671}}) {
    const Outcome o = run("lab collide-squares --law paper --speed " + std::to_string(r.speed));
    ASSERT_EQ(o.code, 0) << o.err;
    const Json c = Json::parse(o.out);
    EXPECT_NEAR(c.at("translation"), r.translation, 0.003) << r.speed;
    EXPECT_NEAR(c.at("rotation"), r.rotation, 0.003) << r.speed;
    EXPECT_NEAR(c.at("omega_final"), r.spin, 0.003) << r.speed;
    EXPECT_NEAR(double(c.at("dissipated")) + double(c.at("translation")) + double(c.at("rotation")), 1, 1e-14);
  }
}

// v_tc = 71.6 cm/s: the final spin is half of that after the first contact.
TEST_F(LabCollideSquares, HasTheSpeedBetweenTwoContactsAndOne) {
  const auto excess = [&](const char* speed) {
    const Json c = Json::parse(run(std::string("lab collide-squares --speed ") + speed).out);
    return double(c.at("omega_final")) / double(c.at("omega_first")) - 0.5;
  };
  EXPECT_LT(excess("71.3"), 0);
  EXPECT_GT(excess("71.9"), 0);
}

TEST_F(LabCollideSquares, IsConvergedAndMirrors) {
  const std::string law = "lab collide-squares --law overlap-energy --speed 50 ";
  const Json asked = Json::parse(run(law).out), fine = Json::parse(run(law + "--integrator gear --step 0.0025").out);
  const Json mirrored = Json::parse(run(law + "--offset -0.5").out);
  for (const char* key : {"translation", "rotation", "omega_first", "omega_final"})
    EXPECT_NEAR(asked.at(key), fine.at(key), 1e-3) << key;
  EXPECT_NEAR(mirrored.at("omega_final"), -double(asked.at("omega_final")), 1e-9);
  // Without dampers the law loses nothing.
  const Json free = Json::parse(run(law + "--damping 0 --step 0.005").out);
  EXPECT_NEAR(free.at("dissipated"), free.at("stored"), 1e-3);
  EXPECT_GT(free.at("stored"), 0.05);
}

TEST_F(LabCollideSquares, RefusesBadInput) {
  const auto refused = [&](const std::string& arguments, const std::string& reason) {
    const Outcome o = run("lab collide-squares " + arguments);
    EXPECT_EQ(o.code, 2) << arguments;
    EXPECT_THAT(o.err, HasSubstr(reason)) << arguments;
  };
  refused("", "--speed: is required");
  refused("--speed 0", "--speed = 0.0: in [0.1, 500] cm/s");
  refused("--speed fast", "--speed");
  refused("--speed 50 --offset 1", "the squares miss each other");
  refused("--speed 50 --side -1", "--side");
  refused("--speed 50 --damping -1", "--damping = -1.0: not negative");
  refused("--speed 50 --law linear", "overlap-energy");
  refused("--speed 50 --step 2", "where the square is stable");
  refused("--speed 50 --step 0.5 --integrator gear", "where the square is stable");
  refused("50", "the speed is --speed V");
}

TEST_F(LabThroughput, MarchesTriangles) {
  write(
      "pair.net",
      "triangle 0 0 0 0 0.1 0 0 0.1\ntriangle 1 0 0.1 0 0.1 0.1 0 0.1\ntriangle 2 1 0.099 0 0.2 0 0.1 0.1\nbeam 0 1\n");
  const Outcome o = run("lab throughput " + in_folder("pair.net") + " --steps 1000");
  ASSERT_EQ(o.code, 0) << o.err;
  const Json t = Json::parse(o.out);
  EXPECT_EQ(t.at("grains"), 2);
  EXPECT_EQ(t.at("triangles"), 3);
  EXPECT_EQ(t.at("steps"), 1000);
  EXPECT_NEAR(double(t.at("triangle_steps_per_cpu_second")) / double(t.at("grain_steps_per_cpu_second")), 1.5, 1e-12);
  EXPECT_NEAR(double(t.at("triangle_steps_per_cpu_second")) * double(t.at("cpu_seconds")), 3000, 1e-6);
  const Outcome refused = run("lab throughput " + in_folder("pair.net") + " --law friction");
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.err, HasSubstr("of disks only"));
}

}  // namespace
}  // namespace isostat
