// A user's own grains: unlike densities and boxes of files, the step that they bear, agitation without cohesion, and
// runs that go on from a state with all of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "dem/disks/engine.hpp"
#include "dem/disks/physical_hash.hpp"
#include "dem/disks/sample.hpp"
#include "dem/disks/scales.hpp"
#include "dem/disks/stage.hpp"
#include "dem/files/packing_file.hpp"
#include "dem/files/state_file.hpp"
#include "dem/input_error.hpp"
#include "dem/run/stages.hpp"
#include "dem/spheres/sample.hpp"
#include "dem/spheres/stage.hpp"
#include "dem/spheres/time_step.hpp"
#include "tests/support/temporary_folder.hpp"

namespace isostat {
namespace {

using ::testing::HasSubstr;

template <class Begin>
std::string refusal(Begin begin) {
  try {
    begin();
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

class OwnGrains : public ::testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& text) const {
    const std::string path = folder_ / name;
    std::ofstream(path) << text;
    return path;
  }
  TemporaryFolder folder_;
};

TEST_F(OwnGrains, DensitiesOfATableAreOverThatOfAGrainOfDiameterAndMassOne) {
  Scene scene;
  scene.grains.file = file("grains.csv", "id,x,y,r,density\n7,1,1,0.5,1\n8,3,1,0.25,4\n");
  scene.grains.box = {6, 5};
  const State<Disks> s = initial_disks(scene, 1);
  EXPECT_EQ(s.packing.cell->length, (Vec2{{6, 5}}));
  EXPECT_DOUBLE_EQ(s.packing.bodies.mass[0], 1);
  EXPECT_DOUBLE_EQ(s.packing.bodies.mass[1], 4 * 0.25);
  EXPECT_DOUBLE_EQ(s.packing.bodies.inertia[1], 4 * 0.25 * 0.25 / 8);

  Scene space = default_scene(SceneSystem::spheres);
  space.sphere_grains.file = file("space.csv", "id,x,y,z,r,density\n7,1,1,1,0.5,1\n8,3,1,2,0.25,4\n");
  space.sphere_grains.box = {6, 5, 4}, space.sphere_grains.density = 3;
  const State<Spheres> t = initial_spheres(space, 1);
  EXPECT_EQ(t.packing.cell->length, (Vec3{{6, 5, 4}}));
  EXPECT_DOUBLE_EQ(t.packing.bodies.mass[0], 3 * std::numbers::pi / 6);
  EXPECT_DOUBLE_EQ(t.packing.bodies.mass[1], 12 * std::numbers::pi / 6 / 8);
  // Heavier grains are slower: the smaller one, as it is, would bear as much as its material, and no less.
  EXPECT_DOUBLE_EQ(t.time_step, 0.1 * contact_time(t.law, 0.25, 3));
}

TEST_F(OwnGrains, MassesOfAFileCountWhereDensitiesDiffer) {
  Scene scene;
  scene.grains.file = file("unlike.csv", "id,x,y,r,m\n0,1,1,0.5,1\n1,3,1,0.25,0.5\n");
  EXPECT_EQ(initial_disks(scene, 1).packing.bodies.mass, (std::vector<double>{1, 0.5}));
  scene.grains.file = file("alike.csv", "id,x,y,r,m\n0,1,1,0.5,8\n1,3,1,0.25,2\n");
  EXPECT_EQ(initial_disks(scene, 1).packing.bodies.mass, (std::vector<double>{1, 0.25})) << "in another unit";
}

TEST_F(OwnGrains, ABoxIsForFilesOfEveryFormatThatHaveNone) {
  Scene scene;
  scene.stages.resize(1);
  scene.stages[0].pressure = 1;
  const auto begin = [&] { (void)initial_disks(scene, 1); };
  Scene free = scene;
  free.stages.clear();
  free.grains.file = file("isolated.net", "grain 0 1 1 0.5\ngrain 1 4.9 1 0.5\n");
  write_state(initial_disks(free, 1), folder_ / "isolated.h5");
  const std::string csv = file("grains.csv", "id,x,y,r\n0,1,1,0.5\n1,4.9,1,0.5\n");
  for (const std::string& path : {csv, folder_ / "isolated.net", folder_ / "isolated.h5"}) {
    scene.grains.file = path, scene.grains.box.clear();
    EXPECT_THAT(refusal(begin), HasSubstr("grains.box gives it one")) << path;
    scene.grains.box = {5, 4};
    EXPECT_EQ(initial_disks(scene, 1).packing.cell->length, (Vec2{{5, 4}})) << path;
    scene.grains.box = {5, 4, 3};
    EXPECT_THAT(refusal(begin), HasSubstr("grains.box")) << path;
    EXPECT_THAT(refusal(begin), HasSubstr("needs 2 edges")) << path;
    scene.grains.box = {4.2, 4};
    EXPECT_THAT(refusal(begin), HasSubstr("overlap by 0.7")) << path << ": across the edge";
  }
  scene.grains.box = {5, 4};
  scene.grains.file = file("cell.net", "cell 6 6\ngrain 0 1 1 0.5\n");
  EXPECT_THAT(refusal(begin), HasSubstr("has its own cell; leave grains.box out"));
  scene.grains.box.clear();
  write_state(initial_disks(scene, 1), folder_ / "cell.h5");
  scene.grains.file = folder_ / "cell.h5", scene.grains.box = {5, 4};
  EXPECT_THAT(refusal(begin), HasSubstr("has its own cell; leave grains.box out"));
}

TEST_F(OwnGrains, WithoutAKeyTheStepIsWhatTheSmallestAndLightestBear) {
  Scene scene;
  scene.grains.count = 60, scene.grains.solid_fraction = 0.3;
  State<Disks> s = initial_disks(scene, 1);
  double heaviest = 0;
  for (const double m : s.packing.bodies.mass) heaviest = std::max(heaviest, m);
  EXPECT_DOUBLE_EQ(s.time_step, 0.06 * std::sqrt(heaviest / 1e5)) << "the reference, where it is fine";

  scene.grains.sizes = SizeLaw::bidisperse, scene.grains.diameter_min = 0.05, scene.grains.large_share = 0.2;
  s = initial_disks(scene, 1);
  EXPECT_DOUBLE_EQ(s.time_step, 0.5 * critical_time_step(s.law, 0.05));
  EXPECT_DOUBLE_EQ(scales(s).critical_time_step, critical_time_step(s.law, 0.05));

  scene.grains.diameter_min = 0.5, scene.grains.density_ratio = 1e-3;  // large and light
  s = initial_disks(scene, 1);
  EXPECT_DOUBLE_EQ(s.time_step, 0.5 * critical_time_step(s.law, 1, 1e-3));
  const auto disks_at = [&](double fraction) {
    scene.step.fraction = fraction;
    const auto found = conflicts(scene);
    return std::any_of(found.begin(), found.end(), [](const auto& c) { return c.key == "step.fraction"; });
  };
  const double bound = critical_time_step(s.law, 1, 1e-3) / std::sqrt(0.25 / 1e5);
  EXPECT_TRUE(disks_at(1.01 * bound));
  EXPECT_FALSE(disks_at(0.99 * bound));
}

TEST_F(OwnGrains, AMeasuredStepIsRefusedOnceItsTableIsRead) {
  Scene scene;
  scene.grains.count = 50, scene.grains.sizes = SizeLaw::table, scene.grains.solid_fraction = 0.3;
  scene.grains.size_table = file("sizes.csv", "diameter,share\n3,0.5\n100,0.5\n");
  EXPECT_EQ(refusal([&] { (void)initial_disks(scene, 1); }), "");
  scene.step.fraction = 0.06;
  EXPECT_THAT(refusal([&] { (void)initial_disks(scene, 1); }), HasSubstr("step.fraction"));
}

TEST_F(OwnGrains, AgitationWithoutCohesionIsInUnitsOfTheFirstStress) {
  StageScene drawn, pressed;
  drawn.velocity = 3, pressed.pressure = 4;
  Scene scene;
  scene.grains.count = 100, scene.law.attraction = 0;
  const auto rms = [&] {
    State<Disks> s = initial_disks(scene, 1);
    agitate(s, scene.stages[0]);
    double sum = 0;
    for (const Vec2& v : s.packing.bodies.velocity) sum += dot(v, v);
    return std::sqrt(sum / 100);
  };
  scene.stages = {drawn};
  EXPECT_NEAR(rms(), 3, 1e-12);  // a/T0
  scene.stages = {drawn, pressed};
  EXPECT_NEAR(rms(), 6, 1e-12);  // 3 a sqrt(P/m)
  EXPECT_EQ(scales(initial_disks(scene, 1)).velocity, 2);
  scene.law.attraction = 1;
  EXPECT_NEAR(rms(), 3 * std::sqrt(1e-3), 1e-12);

  Scene space = default_scene(SceneSystem::spheres);
  space.sphere_grains.count = 50, space.sphere_grains.solid_fraction = 0.2;
  space.stages = {drawn, pressed};
  State<Spheres> s = initial_spheres(space, 1);
  agitate(s, space.stages[0]);
  double sum = 0;
  for (const Vec3& v : s.packing.bodies.velocity) sum += dot(v, v);
  EXPECT_NEAR(std::sqrt(sum / 50), 6, 1e-12);
}

// Unlike densities, no cohesion, no step: in equilibrium, and again from each checkpoint and from the state as a file.
TEST_F(OwnGrains, APackingOfTwoDensitiesComesToRestAndGoesOn) {
  Scene scene;
  scene.grains.count = 60, scene.grains.solid_fraction = 0.7;
  scene.grains.sizes = SizeLaw::bidisperse, scene.grains.diameter_min = 0.6, scene.grains.density_ratio = 3;
  scene.law.normal_stiffness = 1e4, scene.law.attraction = 0;
  scene.finish.method = Finish::drag, scene.finish.quiet_time = 2;
  StageScene gas, press;
  gas.velocity = 0.3, gas.until = Until::time, gas.time = 3;
  press.pressure = 1;
  scene.stages = {gas, press};
  State<Disks> straight = initial_disks(scene, 2);
  ASSERT_TRUE(run_stages(straight, {}, {}).all_met());
  EXPECT_TRUE(straight.certificate.equilibrated);

  const std::string path = folder_ / "state.h5";
  State<Disks> s = initial_disks(scene, 2);
  for (bool done = false; !done;) {
    int polls = 0;
    RunHooks<Disks> hooks;
    hooks.interrupted = [&] { return ++polls > 40; };
    done = !run_stages(s, {}, hooks).interrupted;
    write_state(s, path);
    s = read_state<Disks>(path);
  }
  EXPECT_EQ(physical_hash(s), physical_hash(straight));

  scene.grains.file = path;
  State<Disks> next = initial_disks(scene, 3);
  EXPECT_EQ(next.packing.bodies.mass, s.packing.bodies.mass);
  for (std::size_t k = 0; k < next.packing.bodies.size(); ++k) {
    const double d = 2 * next.packing.bodies.radius[k];
    EXPECT_DOUBLE_EQ(next.packing.bodies.mass[k], (d == 1 ? 3 : 1) * d * d);
  }
}

}  // namespace
}  // namespace isostat
