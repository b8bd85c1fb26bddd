// Scenes of triangles: their keys and defaults, what is refused, and that scenes of disks know nothing of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dem/input_error.hpp"
#include "dem/scene/file.hpp"
#include "dem/scene/text.hpp"
#include "dem/triangles/grain_shape.hpp"
#include "dem/triangles/stable_step.hpp"
#include "dem/triangles/time_step.hpp"

namespace isostat {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

std::vector<Fault> faults_of(const std::string& text) {
  try {
    parse_scene(text, "scene.toml");
  } catch (const InputError& error) {
    return error.faults();
  }
  return {};
}

const std::string kTriangles = "system = \"triangles\"\n";
const std::string kTime = "[[stage]]\nuntil = \"time\"\ntime = 1\n";

TEST(TriangleScene, HasItsOwnKeysAndDefaults) {
  const Scene s = parse_scene(kTriangles +
                                  "[grains]\ncount = 7\nshape = \"square, polygon6\"\n[law]\nfriction = 0.3\n"
                                  "failure = \"break\"\nlimit_tension = 50\n[[stage]]\npressure = 100\n",
                              "scene.toml");
  EXPECT_EQ(s.system, SceneSystem::triangles);
  EXPECT_EQ(s.triangle_grains.count, 7);
  EXPECT_EQ(s.grains, GrainsScene{});
  EXPECT_EQ(s.law, LawScene{});
  EXPECT_EQ(s.triangle_law.friction, 0.3);
  EXPECT_EQ(s.triangle_law.limit_tension, 50.0);
  EXPECT_FALSE(s.triangle_law.limit_shear);
  EXPECT_EQ(triangle_step_fraction(s), 0.6);
  EXPECT_EQ(s.stages.at(0).max_time, 60.0);
  EXPECT_EQ(s.finish.drag, 50.0);
  EXPECT_EQ(shape_names(s.triangle_grains.shape), (std::vector<std::string>{"square", "polygon6"}));
}

TEST(TriangleScene, EchoOfDisksKnowsNothingOfSystemsNorContainers) {
  const Scene disks = parse_scene("[[stage]]\npressure = 0.01\n", "scene.toml");
  const std::string text = scene_to_toml(disks);
  EXPECT_THAT(text, StartsWith("seed = 1\n\n[grains]\n"));
  for (const char* word : {"system", "gravity", "container", "open", "vibration", "rotation", "clog"})
    EXPECT_THAT(text, Not(HasSubstr(word)));
  Scene hopper = disks;
  hopper.container.shape = ContainerShape::hopper;
  hopper.stages[0].container.open = true;
  EXPECT_THAT(scene_to_toml(hopper), HasSubstr("[container]\nshape = \"hopper\"\nwalls = \"grains\"\nwidth = 4.0\n"));
  EXPECT_THAT(scene_to_toml(hopper), HasSubstr("open = true\n"));
}

TEST(TriangleScene, ShippedScenesObeyTheRules) {
  for (const char* name :
       {"squares-collision", "hopper", "hopper-vibrated", "drum", "triangles-settle", "triangles-compress"}) {
    const Scene s = read_scene(std::string(ISOSTAT_DATA "/scenes/") + name + ".toml");
    EXPECT_EQ(s.system, SceneSystem::triangles) << name;
    EXPECT_THAT(scene_to_toml(s), HasSubstr("system = \"triangles\"\n")) << name;
  }
}

struct Case {
  std::string text, key, rule;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.text << c.key; }

class TriangleSceneFault : public ::testing::TestWithParam<Case> {};

TEST_P(TriangleSceneFault, IsFoundAlone) {
  const std::vector<Fault> faults = faults_of(GetParam().text);
  ASSERT_EQ(faults.size(), 1u) << (faults.empty() ? "" : InputError(faults).what());
  EXPECT_EQ(faults[0].key, GetParam().key);
  EXPECT_THAT(faults[0].rule, HasSubstr(GetParam().rule));
}

const std::string kHopper = kTriangles + "gravity = 981\n[container]\nshape = \"hopper\"\n";
const std::string kDrum = kTriangles + "gravity = 981\n[container]\nshape = \"drum\"\n";
const std::string kCollision = kTriangles + "[grains]\narrangement = \"collision\"\n";

INSTANTIATE_TEST_SUITE_P(
    Keys, TriangleSceneFault,
    ::testing::Values(
        Case{"system = \"triangle\"\n[law]\nmodulus = 1\n" + kTime, "system", "one of \"disks\" \"triangles\""},
        Case{"[law]\nmodulus = 1e7\n" + kTime, "law.modulus", "a key of triangles, and this scene is of disks"},
        Case{kTriangles + "[law]\nrolling = true\n" + kTime, "law.rolling", "a key of disks, and this scene is of tri"},
        Case{kTriangles + "[[stage]]\npressure = 10\nvelocity = 1\n", "stage.0.velocity", "a key of disks"},
        Case{kTriangles + "[[stage]]\npressure = 10\nnormal_stiffness = 1\n", "stage.0.normal_stiffness", "of disks"},
        Case{kTriangles + kTime + "[units]\n", "units", "a table of disks"},
        Case{kTriangles + kTime + "[units]\na = 1.0\n", "units.a", "a key of disks"},
        Case{kTriangles + "[law]\nmodulos = 1\n" + kTime, "law.modulos", "did you mean law.modulus?"},
        Case{kTriangles + "[law]\nfailure = \"snap\"\n" + kTime, "law.failure", "\"yield\""},
        Case{kTriangles + "gravity = -1\n" + kTime, "gravity", ">= 0 [cm/s^2]"},
        Case{"gravity = -1\n" + kTime, "gravity", ">= 0 [a/T0^2]"},
        Case{kTriangles + "[step]\nintegrator = \"euler\"\n" + kTime, "step.integrator", "\"verlet\" \"gear\""},
        Case{kHopper + "angle = 90\n" + kTime, "container.angle", "(0, 90)"}));

INSTANTIATE_TEST_SUITE_P(
    Rules, TriangleSceneFault,
    ::testing::Values(
        Case{kTriangles + "[grains]\nsize_min = 0.3\n" + kTime, "grains.size_min", "at most grains.size_max = 0.2"},
        Case{kTriangles + "[grains]\nshape = \"sqare\"\n" + kTime, "grains.shape", "did you mean square?"},
        Case{kTriangles + "[grains]\nshape = \"square,\"\n" + kTime, "grains.shape", "neither a shape nor a file"},
        Case{kTriangles + "[step]\nfraction = 1.6\n" + kTime, "step.fraction", "unstable for the smallest grain (0.1"},
        Case{kTriangles + "[law]\nmodulus = 1e10\n" + kTime, "step.fraction", "unstable"},
        Case{kTriangles + "[law]\nfailure = \"break\"\n" + kTime, "law.failure", "needs a limit"},
        Case{kTriangles + "[step]\nintegrator = \"gear\"\n" + kTime, "step.fraction", "under \"gear\"; below 0."},
        Case{kTriangles + "[step]\nintegrator = \"gear\"\nfraction = 0.1\n[[stage]]\npressure = 1\n", "step.integrator",
             "needs a cell that stays"},
        Case{kTriangles + "[finish]\nmethod = \"newton\"\n" + kTime, "finish.method", "disks only"},
        Case{kTriangles + "[[stage]]\npressure = 10\nuntil = \"aggregated\"\n", "stage.0.until", "only of disks"},
        Case{kTriangles + "[[stage]]\n", "stage.0.until", "needs gravity, or stage.0.pressure"},
        Case{kTriangles + "gravity = 981\n" + kTime, "gravity", "needs a container"},
        Case{kHopper + "opening = 4.5\n" + kTime, "container.opening", "narrower than the hopper"},
        Case{kDrum + "wall_size = 3\n" + kTime, "container.wall_size", "smaller than the drum"},
        Case{kHopper + "[[stage]]\npressure = 10\n", "stage.0.pressure", "a key of the periodic cell"},
        Case{kHopper + kTime + "strain_rate_2 = 0.0\n", "stage.0.strain_rate_2", "a key of the periodic cell"},
        Case{kHopper + "[output]\nsnapshot_solid_fractions = [0.5]\n" + kTime, "output.snapshot_solid_fractions",
             "needs a periodic cell"},
        Case{kDrum + kTime + "open = true\n", "stage.0.open", "only a hopper has an outlet"},
        Case{kHopper + kTime + "rotation = 0.1\n", "stage.0.rotation", "only a drum turns"},
        Case{kTriangles + kTime + "vibration_amplitude = 0.1\nvibration_frequency = 50\n",
             "stage.0.vibration_amplitude", "needs a container"},
        Case{kHopper + kTime + "vibration_amplitude = 0.1\n", "stage.0.vibration_frequency", "greater than 0"},
        Case{kHopper + kTime + "vibration_amplitude = 1e-6\nvibration_frequency = 1e5\n", "stage.0.vibration_frequency",
             "a period needs 20.0 steps"},
        Case{kHopper + kTime + "vibration_amplitude = 1\nvibration_frequency = 50\n", "stage.0.vibration_amplitude",
             "closes on grains"},
        Case{kDrum + kTime + "rotation = -1e3\n", "stage.0.rotation", "closes on grains"},
        Case{kDrum + "[[stage]]\nrotation = 0.1\n", "stage.0.until", "never come to rest"},
        Case{kDrum + "[[stage]]\nuntil = \"empty\"\n", "stage.0.until", "only a hopper has an outlet"},
        Case{kHopper + "[[stage]]\nuntil = \"clogged\"\n", "stage.0.until", "needs stage.0.open = true"},
        Case{kTriangles + "[[stage]]\nuntil = \"separated\"\n", "stage.0.until", "only of a collision"},
        Case{"[[stage]]\nuntil = \"separated\"\n", "stage.0.until", "only of a collision"},
        Case{kCollision + "[container]\nshape = \"box\"\n" + kTime, "grains.arrangement", "free space"},
        Case{kCollision + kTime + "pressure = 1\n", "stage.0.pressure", "two grains collide in free space"}));

TEST(TriangleScene, TheOutletMayHaveBeenOpenedByAStageBefore) {
  EXPECT_TRUE(faults_of(kHopper + kTime + "open = true\n[[stage]]\nuntil = \"empty\"\n").empty());
}

TEST(TriangleTimeStep, BoundIsThatOfTheSmallestSquare) {
  const Scene scene = parse_scene(kTriangles + kTime, "scene.toml");
  const GrainTemplate grain = grain_template(grain_shape("square", 0.1), material_of(scene));
  const double bound = largest_step(grain, 2e7, Integrator::verlet) * step_frequency(grain, 2e7);
  EXPECT_DOUBLE_EQ(largest_step(grain, 2e7, Integrator::verlet),
                   stable_step(grain, SpinInDampers::torque_and_force).verlet);
  EXPECT_TRUE(faults_of(kTriangles + "[step]\nfraction = " + real_text(0.999 * bound) + "\n" + kTime).empty());
  EXPECT_FALSE(faults_of(kTriangles + "[step]\nfraction = " + real_text(1.001 * bound) + "\n" + kTime).empty());
}

// Two of them with a side on each other: omega^2 = 2 K / m, K = Y s^2 / l, through both centroids.
TEST(TriangleTimeStep, ARigidTriangleHasTheFrequencyOfItsContact) {
  const double side = 0.2, modulus = 2e7, area = std::sqrt(3) / 4 * side * side;
  const GrainTemplate grain = grain_template(grain_shape("triangle", side), {});
  const double stiffness = modulus * side * side / std::sqrt(area);
  EXPECT_NEAR(step_frequency(grain, modulus), std::sqrt(2 * stiffness / area), 1e-9 * step_frequency(grain, modulus));
}

}  // namespace
}  // namespace isostat
