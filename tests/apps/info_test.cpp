// isostat info, and what all commands share: help, version, exit codes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "dem/files/atomic_file.hpp"
#include "dem/files/state_file.hpp"
#include "dem/files/state_seal.hpp"
#include "dem/scene/file.hpp"
#include "dem/triangles/time_step.hpp"
#include "dem/triangles/vtp.hpp"
#include "tests/apps/program.hpp"
#include "tests/support/triangle_state.hpp"

namespace isostat {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using InfoCommand = Program;
using AnyCommand = Program;

// Two disks of diameters 1 and 1/2 in a cell.
State<Disks> two_disks() {
  State<Disks> s;
  s.packing.cell = PeriodicCell<2>{{{4, 5}}};
  s.packing.bodies.resize(2);
  s.packing.bodies.id = {1, 2};
  s.packing.bodies.position = {{{1, 1}}, {{1.75, 1}}};
  s.packing.bodies.radius = {0.5, 0.25};
  s.packing.bodies.mass = {1, 0.25};
  s.packing.bodies.inertia = {0.125, 0.0078125};
  s.packing.links.push_back({.i = 0, .j = 1, .kind = LinkKind::distant, .normal_force = -1.0});
  s.scene = read_scene(ISOSTAT_DATA "/scenes/disks-method1.toml");
  s.law = resolve(s.scene.law);
  s.time = 12.5, s.time_step = 0.06 * std::sqrt(1e-5), s.imposed_stress = isotropic<2>(0.01);
  s.seed = 18446744073709551615u;
  return s;
}

TEST_F(InfoCommand, PrintsTheContract) {
  const State<Disks> state = two_disks();
  write_state(state, in_folder("state.h5"), {"9.9", "", "pack scene.toml"});
  const Outcome o = run("info " + in_folder("state.h5"));
  ASSERT_EQ(o.code, 0) << o.err;
  const json j = json::parse(o.out);
  EXPECT_EQ(j["format_version"], kStateFormatVersion);
  EXPECT_EQ(j["hash"], read_state_file(in_folder("state.h5")).hash);
  EXPECT_EQ(j["cell"], json({4.0, 5.0}));
  EXPECT_EQ(j["time"], 12.5);
  EXPECT_EQ(j["seed"], 18446744073709551615u);
  EXPECT_EQ(j["scene"]["grains"]["count"], 1400);
  EXPECT_EQ(j["scene"]["law"]["friction"], 0.5);
  EXPECT_EQ(j["scene"]["law"]["rolling_friction"], nullptr);
  EXPECT_EQ(j["scene"]["finish"]["method"], "newton");
  EXPECT_EQ(j["scene"]["stage"][0]["pressure"], 0.01);
  EXPECT_FALSE(j["scene"].contains("units"));
  EXPECT_EQ(j["law"]["rolling_friction"], 0.005);
  EXPECT_EQ(j["law"]["tangential_stiffness"], 1e5);
  const json& s = j["scales"];
  EXPECT_DOUBLE_EQ(s["kappa"], 1e5);
  EXPECT_DOUBLE_EQ(s["P*"], 0.01);
  EXPECT_DOUBLE_EQ(s["h0_over_D0"], 0.01);
  EXPECT_NEAR(s["e_N"], std::exp(-std::numbers::pi * 0.8 / 0.6), 1e-15);
  EXPECT_DOUBLE_EQ(s["V*"], std::sqrt(1e-3));
  EXPECT_EQ(s["T0"], 1.0);
  EXPECT_EQ(s["dt"], state.time_step);
  // smallest disk, m = 1/4, d = 1/2: omega^2 = 24 K_T / m + 96 K_r / (m d^2) with K_r = 1e-4 K_N
  EXPECT_NEAR(s["dt_critical"].get<double>(), 2 / std::sqrt(24e5 / 0.25 + 96 * 10 / (0.25 * 0.25)), 1e-15);
  EXPECT_EQ(j["provenance"]["version"], "9.9");
  EXPECT_EQ(j["provenance"]["command"], "pack scene.toml");
  EXPECT_FALSE(j.contains("si"));
}

TEST_F(InfoCommand, GivesSiWithUnitsAndNullWithoutCohesion) {
  State<Disks> state = two_disks();
  state.scene.units = UnitsScene{1e-5, 1e-2, 1e-8};  // m = density pi a^2/4, T0 = sqrt(m a / F0)
  write_state(state, in_folder("state.h5"));
  const json si = json::parse(run("info " + in_folder("state.h5")).out)["si"];
  const double mass = 1e-2 * std::numbers::pi * 1e-10 / 4, time = std::sqrt(mass * 1e-5 / 1e-8);
  EXPECT_NEAR(si["m"].get<double>() / mass, 1, 1e-14);
  EXPECT_NEAR(si["T0"].get<double>() / time, 1, 1e-14);
  EXPECT_NEAR(si["V*"].get<double>() / (std::sqrt(1e-3) * 1e-5 / time), 1, 1e-14);
  EXPECT_NEAR(si["P"].get<double>() / (0.01 * 1e-8 / 1e-5), 1, 1e-14);
  EXPECT_NEAR(si["K_N"].get<double>() / (1e5 * 1e-8 / 1e-5), 1, 1e-14);

  state.law.attraction = state.law.attraction_range = 0;
  state.packing.cell.reset();
  write_state(state, in_folder("dry.h5"));
  const json dry = json::parse(run("info " + in_folder("dry.h5")).out);
  EXPECT_NEAR(dry["scales"]["V*"].get<double>(), std::sqrt(0.01), 1e-15);  // a sqrt(P/m), the unit of agitation
  EXPECT_EQ(dry["scales"]["h0_over_D0"], nullptr);
  EXPECT_EQ(dry["cell"], nullptr);
}

// Gilabert 2007, Sec. II.C: for toner F0/a^2 is of the order of 100 Pa, P* = .01 about 1 Pa, T0 some 1e-5 s, V* about
// 1 cm/s, D0 10 nm, and K_N = 1e5 F0/a stands for E = 3.2 GPa.
TEST_F(InfoCommand, GivesTheNumbersOfTheTonerOfThePaper) {
  const Outcome o = run("pack " ISOSTAT_DATA
                        "/scenes/toner.toml --set grains.count=20 "
                        "--max-time 0.5 -o " +
                        in_folder("toner.h5"));
  ASSERT_EQ(o.code, 3) << o.err;  // stopped early
  State<Disks> state = read_state<Disks>(in_folder("toner.h5"));
  state.imposed_stress = isotropic<2>(state.scene.stages.back().pressure);
  write_state(state, in_folder("loaded.h5"));
  const json j = json::parse(run("info " + in_folder("loaded.h5")).out), si = j["si"];
  const double a = si["a"], f0 = si["F0"];
  EXPECT_DOUBLE_EQ(f0 / (a * a), 100);
  EXPECT_NEAR(si["P"].get<double>() / a, 1, 1e-12);  // Pa, a layer of thickness a
  EXPECT_DOUBLE_EQ(j["scales"]["P*"], 0.01);
  EXPECT_GT(si["T0"].get<double>(), 1e-5);
  EXPECT_LT(si["T0"].get<double>(), 3e-5);
  EXPECT_NEAR(si["V*"].get<double>(), 0.01, 0.005);
  EXPECT_NEAR(si["m"].get<double>(), 1000 * std::numbers::pi / 6 * a * a * a, 1e-3 * si["m"].get<double>());
  EXPECT_DOUBLE_EQ(state.law.attraction_range * a, 1e-8);
  EXPECT_NEAR(std::pow(state.law.normal_stiffness, 1.5) * f0 / (a * a), 3.2e9,
              0.05e9);  // E of kappa = (E a^2/F0)^(2/3)
}

TEST_F(InfoCommand, TellsTheSystemAndItsOwnNumbers) {
  write_state(two_disks(), in_folder("disks.h5"));
  EXPECT_EQ(json::parse(run("info " + in_folder("disks.h5")).out)["system"], "disks");
  State<TriangleGrains> state = random_triangle_state(2, false);
  state.scene = default_scene(SceneSystem::triangles, 2), state.time_step = 1.2e-5;
  write_state(state, in_folder("triangles.h5"));
  const Outcome o = run("info " + in_folder("triangles.h5"));
  ASSERT_EQ(o.code, 0) << o.err;
  const json j = json::parse(o.out);
  EXPECT_EQ(j["system"], "triangles");
  EXPECT_EQ(j["format_version"], kStateFormatVersion);
  EXPECT_EQ(j["hash"], read_state_file(in_folder("triangles.h5")).hash);
  EXPECT_EQ(j["cell"], nullptr);
  EXPECT_EQ(j["seed"], state.seed);
  EXPECT_EQ(j["grains"], 2);
  EXPECT_EQ(j["wall_grains"], 2);
  EXPECT_EQ(j["triangles"], 10);
  EXPECT_EQ(j["beams"], 8);
  EXPECT_EQ(j["events"], 2);
  EXPECT_EQ(j["scene"]["system"], "triangles");
  EXPECT_EQ(j["law"]["contact"], "paper");
  EXPECT_EQ(j["law"]["damping"], state.law.damping);
  EXPECT_EQ(j["law"]["limit_shear"], nullptr);  // never
  EXPECT_EQ(j["scales"]["dt"], 1.2e-5);
  EXPECT_DOUBLE_EQ(j["scales"]["omega_max"], triangle_step_fraction(state.scene) / 1.2e-5);
}

TEST_F(AnyCommand, ConvertKeepsTrianglesWhereItCan) {
  const State<TriangleGrains> state = random_triangle_state(3, false);
  write_state(state, in_folder("t.h5"));
  ASSERT_EQ(run("convert " + in_folder("t.h5") + " -o " + in_folder("copy.h5")).code, 0);
  EXPECT_EQ(read_state_file(in_folder("copy.h5")).hash, read_state_file(in_folder("t.h5")).hash);
  ASSERT_EQ(run("convert " + in_folder("t.h5") + " -o " + in_folder("t.vtp")).code, 0);
  EXPECT_EQ(read_whole_file(in_folder("t.vtp")), vtk_polydata(state.packing, state.time));
  const Outcome refused = run("convert " + in_folder("t.h5") + " -o " + in_folder("t.csv"));
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.err, HasSubstr("triangles are kept by .h5 and .net files only"));
}

TEST_F(AnyCommand, BadUsageAndInputExitWithTwo) {
  const Outcome missing = run("info " + in_folder("none.h5"));
  EXPECT_EQ(missing.code, 2);
  EXPECT_THAT(missing.err, HasSubstr("none.h5"));
  EXPECT_EQ(missing.out, "");
  EXPECT_EQ(run("info").code, 2);
  EXPECT_EQ(run("info a b").code, 2);
  EXPECT_EQ(run("").code, 2);
  const Outcome unknown = run("inof state.h5");
  EXPECT_EQ(unknown.code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("did you mean info?"));
  EXPECT_THAT(run("info --jsn x").err, HasSubstr("--jsn: unknown option"));
}

TEST_F(AnyCommand, HelpAndVersionGoToStdout) {
  EXPECT_EQ(run("--version").code, 0);
  EXPECT_THAT(run("--version").out, HasSubstr("isostat "));
  EXPECT_THAT(run("--help").out, HasSubstr("info"));
  EXPECT_EQ(run("info --help").code, 0);
  EXPECT_THAT(run("info --help").out, HasSubstr("isostat info STATE"));
}

TEST_F(AnyCommand, FullStandardOutputIsNoSuccess) {
  write_state(two_disks(), in_folder("state.h5"));
  const std::string command = ISOSTAT_PROGRAM " info " + in_folder("state.h5") + " >/dev/full 2>/dev/null";
  EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 2);
}

}  // namespace
}  // namespace isostat
