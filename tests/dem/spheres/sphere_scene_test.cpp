// Scenes of spheres: keys, what is refused, the states that they begin with, and stages that meet their ends.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dem/files/state_file.hpp"
#include "dem/input_error.hpp"
#include "dem/run/stages.hpp"
#include "dem/scene/file.hpp"
#include "dem/spheres/certificate.hpp"
#include "dem/spheres/engine.hpp"
#include "dem/spheres/sample.hpp"
#include "dem/spheres/stage.hpp"
#include "dem/spheres/time_step.hpp"
#include "dem/state/clusters.hpp"
#include "dem/state/solid_fraction.hpp"
#include "tests/support/temporary_folder.hpp"

namespace isostat {
namespace {

using ::testing::HasSubstr;

const std::string kSpheres = "system = \"spheres\"\n";

Scene scene_of(const std::string& text) { return parse_scene(kSpheres + text, "scene.toml"); }

// The only fault: its key, and its rule.
void expect_refused(const std::string& text, const std::string& key, const std::string& rule) {
  try {
    scene_of(text);
    ADD_FAILURE() << text << " was taken";
  } catch (const InputError& error) {
    ASSERT_EQ(error.faults().size(), 1u) << error.what();
    EXPECT_EQ(error.faults()[0].key, key) << text;
    EXPECT_THAT(error.faults()[0].rule, HasSubstr(rule)) << text;
  }
}

const std::string kPressed = "[[stage]]\npressure = 1\n";
const std::string kTime = "[[stage]]\nuntil = \"time\"\ntime = 1\n";
const std::string kSoft =
    "[grains]\narrangement = \"soft-particle-wall\"\nshell_radius = 1\ndiameter_max = 1\ndiameter_min = 0.25\n"
    "exponent = 3.5\ntrials = 100\n";

TEST(SphereScene, RefusesWhatCannotBe) {
  expect_refused("[grains]\ndiameter_min = 2.0\n" + kPressed, "grains.diameter_min", "at most grains.diameter_max");
  expect_refused("[grains]\ndiameter_min = 0.0\n" + kPressed, "grains.diameter_min", "> 0");
  expect_refused("[law]\nmodulus = 0\n" + kPressed, "law.modulus", "> 0");
  expect_refused("[law]\npoisson = 0.6\n" + kPressed, "law.poisson", "0.5");
  expect_refused("[law]\nmodulus = 10\n" + kPressed, "law.modulus", "too soft");
  expect_refused("[step]\nfraction = 0.5\n" + kPressed, "step.fraction", "unstable");
  expect_refused("[finish]\nmethod = \"newton\"\n" + kPressed, "finish.method", "static solves are of disks");
  expect_refused("[output]\nseries = \"s.csv\"\nenergies = true\n" + kPressed, "output.energies", "no energy ledger");
  expect_refused("[[stage]]\npressure = 0\n", "stage.0.pressure", "greater than 0");
  expect_refused("[[stage]]\npressure = 1\nuntil = \"aggregated\"\n", "stage.0.until", "needs law.attraction > 0");
  expect_refused("[[stage]]\npressure = 1\nstress_3 = 2\nstrain_rate_3 = 0.1\nuntil = \"strain\"\nstrain = 0.1\n",
                 "stage.0.strain_rate_3", "not both");
  expect_refused("[container]\nshape = \"box\"\n" + kTime, "container.shape", "containers are of the plane");
  expect_refused(kSoft + "volume_factor = 0.5\n" + kTime, "grains.volume_factor", "1");
  expect_refused(kSoft + "inserted_fraction = 1.0\n" + kTime, "grains.inserted_fraction", "(0, 1)");
  expect_refused("[grains]\nsoft_share = 0.3\n" + kPressed, "grains.soft_radius", "greater than 0");
  expect_refused("[grains]\nsoft_share = 0.3\nsoft_radius = 0.2\n[law]\nsoft_solid = [1.0, 2.0]\n" + kPressed,
                 "law.soft_solid", "six numbers");
  expect_refused("[grains]\nsecond_share = 0.3\n[law]\nrolling = true\n" + kPressed, "law.rolling", "false");
  expect_refused("[grains]\nsecond_share = 0.3\n[law]\nattraction = 1.0\nattraction_range = 0.1\n" + kPressed,
                 "law.attraction", "0, since grains.second_share > 0");
  expect_refused("[grains]\nsecond_share = 0.3\n[law]\nnormal = \"linear\"\n" + kPressed, "law.normal", "hertz");
  expect_refused("[grains]\nsecond_share = 1.3\n" + kPressed, "grains.second_share", "[0, 1]");
  expect_refused(kSoft + "[[stage]]\npressure = 1\n", "stage.0.pressure", "soft-particles have none");
}

TEST(SphereScene, RefusesAShellThatIsSmallerThanTheLargestGrain) {
  expect_refused("[grains]\narrangement = \"soft-particle-wall\"\nshell_radius = 0.4\ndiameter_max = 1\n" + kTime,
                 "grains.arrangement", "");
}

TEST(SphereScene, KeysOfSpaceAreUnknownInThePlane) {
  EXPECT_THROW(parse_scene("[[stage]]\npressure = 1\nstress_3 = 1\n", "scene.toml"), InputError);
  EXPECT_THROW(scene_of("[grains]\nshape = \"square\"\n" + kPressed), InputError);
}

TEST(SphereScene, BeginsWithSpheresThatDoNotTouch) {
  const Scene scene = scene_of("[grains]\ncount = 200\nexponent = 3.5\ndiameter_min = 0.2\n" + kPressed);
  const State<Spheres> s = initial_spheres(scene, 5);
  const Bodies<3>& b = s.packing.bodies;
  ASSERT_EQ(b.size(), 200u);
  EXPECT_NEAR(solid_fraction(b, s.packing.cell), 0.3, 1e-12);
  for (std::size_t i = 0; i < b.size(); ++i) {
    EXPECT_NEAR(b.mass[i], 8 * std::pow(b.radius[i], 3), 1e-12);  // a sphere of diameter a has the mass m
    EXPECT_NEAR(b.inertia[i], 0.4 * b.mass[i] * b.radius[i] * b.radius[i], 1e-14);
    for (std::size_t j = 0; j < i; ++j) {
      Vec3 d = b.position[j] - b.position[i];
      d += s.packing.cell->offset(s.packing.cell->nearest_image(d));
      EXPECT_GT(norm(d), b.radius[i] + b.radius[j]);
    }
  }
  const double smallest = *std::min_element(b.radius.begin(), b.radius.end());
  EXPECT_EQ(s.time_step, 0.1 * contact_time(s.law, smallest, scene.sphere_grains.density));
}

// Frictionless Hertz spheres come to rest under a pressure in three directions; friction comes with the second stage,
// and a restart in between changes no bit.
TEST(SphereScene, RunsItsStagesToCertifiedEquilibrium) {
  const Scene scene = scene_of(
      "[grains]\ncount = 60\ndiameter_min = 0.8\n[law]\nmodulus = 1e3\nfriction = 0.4\n[finish]\nmethod = \"drag\"\n"
      "[[stage]]\nfriction = 0.0\npressure = 1\nmax_strain_rate = 0.5\n"
      "[[stage]]\nfriction = 0.4\nstress_1 = 1.0\nstress_2 = 1.5\nstress_3 = 2.0\nmax_strain_rate = 0.5\n");
  State<Spheres> s = initial_spheres(scene, 1);
  RunHooks<Spheres> hooks;
  const TemporaryFolder folder;
  hooks.stage_end = [&](const State<Spheres>& at) {
    if (at.progress.stage == 1) write_state(at, folder / "between.h5");
  };
  ASSERT_TRUE(run_stages(s, {}, hooks).all_met());
  const State<Spheres> between = read_state<Spheres>(folder / "between.h5");
  EXPECT_EQ(between.law.friction, 0);
  EXPECT_EQ(s.law.friction, 0.4);
  EXPECT_TRUE(s.certificate.equilibrated);
  const Vec3 stress = diagonal(measured_stress(s.packing));
  for (int a = 0; a < 3; ++a) EXPECT_NEAR(stress[a], 1 + 0.5 * a, 1e-3);
  EXPECT_TRUE(std::any_of(s.packing.links.begin(), s.packing.links.end(),
                          [](const Link<3>& l) { return norm(l.tangential_force) > 0; }));
  EXPECT_TRUE(std::all_of(between.packing.links.begin(), between.packing.links.end(),
                          [](const Link<3>& l) { return l.tangential_force == Vec3{}; }));
  State<Spheres> resumed = between;
  ASSERT_TRUE(run_stages(resumed, {}, {}).all_met());
  EXPECT_EQ(encode_state(resumed), encode_state(s));
}

TEST(SphereScene, CohesiveSpheresAggregate) {
  const Scene scene = scene_of(
      "[grains]\ncount = 40\n[law]\nnormal = \"linear\"\nnormal_stiffness = 1e3\ndamping = 0.8\nrolling = true\n"
      "friction = 0.5\nattraction = 1.0\nattraction_range = 0.02\n[finish]\nmethod = \"drag\"\n"
      "[[stage]]\nvelocity = 9.48\nuntil = \"aggregated\"\n");
  State<Spheres> s = initial_spheres(scene, 2);
  ASSERT_TRUE(run_stages(s, {}, {}).all_met());
  EXPECT_EQ(count_clusters(s.packing), 1u);
  EXPECT_TRUE(s.certificate.equilibrated);
}

// The first soft-particle goes as the stage says, shell and grains, and stands when the next one says nothing.
TEST(SphereScene, ASoftParticleApproachesItsPartner) {
  const Scene scene = scene_of(
      kSoft + "[[stage]]\napproach = 0.5\nuntil = \"time\"\ntime = 0.6\n[[stage]]\nuntil = \"time\"\ntime = 0.1\n");
  State<Spheres> s = initial_spheres(scene, 1);
  ASSERT_EQ(s.packing.walls.size(), 2u);
  EXPECT_EQ(s.packing.walls[0].shape, WallShape::shell);
  ASSERT_TRUE(run_stages(s, {}, {}).all_met());
  EXPECT_NEAR(s.packing.walls[0].point[2], -0.3, 0.5 * s.time_step);
  EXPECT_EQ(s.packing.walls[0].velocity, Vec3{});
  EXPECT_TRUE(std::any_of(s.packing.wall_links.begin(), s.packing.wall_links.end(),
                          [](const WallLink& l) { return l.wall == 1 && l.normal_force > 0; }));
  for (const Vec3& r : s.packing.bodies.position) EXPECT_LT(norm(r - s.packing.walls[0].point), 1.05);
}

// Materials are drawn by their share and have their density and modulus; soft-particles fill theirs of the volume.
TEST(SphereScene, MixesMaterialsAndSoftParticles) {
  const Scene scene = scene_of(
      "[grains]\ncount = 2000\nsolid_fraction = 0.3\nsecond_share = 0.25\nsecond_density = 5.0\ndensity = 2.0\n"
      "soft_share = 0.4\nsoft_radius = 0.3\nsoft_density = 1.5\n[law]\nsecond_modulus = 7e4\nwall_friction = 0.7\n" +
      kPressed);
  const State<Spheres> s = initial_spheres(scene, 3);
  const SpherePacking& p = s.packing;
  ASSERT_EQ(p.kind.size(), p.bodies.size());
  double soft = 0, solid = 0;
  std::size_t second = 0;
  for (std::size_t k = 0; k < p.kind.size(); ++k) {
    const double r = p.bodies.radius[k], volume = 4.0 / 3 * std::numbers::pi * r * r * r;
    (p.kind[k] == SphereKind::soft ? soft : solid) += volume;
    second += p.kind[k] == SphereKind::second;
    const double density = p.kind[k] == SphereKind::soft ? 1.5 : p.kind[k] == SphereKind::second ? 5.0 : 2.0;
    EXPECT_NEAR(p.bodies.mass[k], density * volume, 1e-12);
    if (p.kind[k] == SphereKind::soft) {
      EXPECT_EQ(r, 0.3);
    }
  }
  EXPECT_NEAR(soft / (soft + solid), 0.4, 1e-3);
  EXPECT_NEAR(static_cast<double>(second), 500, 80);  // four standard deviations
  EXPECT_EQ(s.law.second.modulus, 7e4);
  EXPECT_EQ(s.law.wall_friction, 0.7);
  EXPECT_LT(s.time_step, initial_spheres(scene_of("[grains]\ncount = 20\n" + kPressed), 3).time_step * 10);
}

TEST(SphereScene, InsertionReachesAFraction) {
  Scene scene = scene_of(
      "[grains]\narrangement = \"insertion\"\nedge = 3.0\ndiameter_min = 0.3\nexponent = 3.5\n"
      "inserted_fraction = 0.55\n" +
      kPressed);
  double volume = 0;
  for (const double r : initial_spheres(scene, 1).packing.bodies.radius)
    volume += 4.0 / 3 * std::numbers::pi * r * r * r;
  EXPECT_NEAR(volume / 27, 0.55, 0.01);
  scene.sphere_grains.inserted_fraction = 0.95;
  EXPECT_THROW(initial_spheres(scene, 1), InputError);
}

// A stage that stops begins at rest.
TEST(SphereScene, AStageStopsWhatMoves) {
  StageScene stage;
  State<Spheres> s = initial_spheres(scene_of("[grains]\ncount = 20\n" + kPressed), 1);
  s.packing.bodies.velocity[3] = {{1, 2, 3}}, s.packing.bodies.spin[4] = {{1, 2, 3}};
  prepare_stage(s, stage);
  EXPECT_EQ(s.packing.bodies.velocity[3], (Vec3{{1, 2, 3}}));
  stage.stop = true;
  prepare_stage(s, stage);
  for (const Vec3& v : s.packing.bodies.velocity) EXPECT_EQ(v, Vec3{});
  for (const Vec3& w : s.packing.bodies.spin) EXPECT_EQ(w, Vec3{});
}

}  // namespace
}  // namespace isostat
