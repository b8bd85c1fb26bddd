// Starts up to close packing: no overlap at the full solid fraction, the same bits for a seed, and a refusal where the
// grains jam.
#include "dem/sample/push_apart.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dem/disks/sample.hpp"
#include "dem/input_error.hpp"
#include "dem/spheres/sample.hpp"

namespace isostat {
namespace {

template <int D>
double smallest_gap(const Packing<D>& p) {
  const Bodies<D>& b = p.bodies;
  double smallest = INFINITY;
  for (std::size_t i = 0; i < b.size(); ++i)
    for (std::size_t j = i + 1; j < b.size(); ++j) {
      const Vec<D> d = b.position[j] - b.position[i];
      smallest = std::min(smallest, norm(d + p.cell->offset(p.cell->nearest_image(d))) - b.radius[i] - b.radius[j]);
    }
  return smallest;
}

Scene disks(double solid_fraction, int count) {
  Scene scene;
  scene.grains.solid_fraction = solid_fraction, scene.grains.count = count;
  scene.stages.resize(1);
  return scene;
}

Scene spheres(double solid_fraction, int count) {
  Scene scene = default_scene(SceneSystem::spheres, 1);
  scene.sphere_grains.solid_fraction = solid_fraction, scene.sphere_grains.count = count;
  return scene;
}

TEST(PushApart, DisksUpToClosePacking) {
  for (const double solid_fraction : {0.66, 0.75, 0.82}) {
    const Scene scene = disks(solid_fraction, 400);
    const State<Disks> s = initial_disks(scene, 3);
    double area = 0;
    for (const double r : s.packing.bodies.radius) area += std::numbers::pi * r * r;
    EXPECT_NEAR(area / s.packing.cell->measure(), solid_fraction, 1e-12);
    EXPECT_GE(smallest_gap(s.packing), scene.law.attraction_range * (1 - 1e-9)) << solid_fraction;
    for (const Vec2& r : s.packing.bodies.position)
      for (int a = 0; a < 2; ++a) EXPECT_TRUE(r[a] >= 0 && r[a] < s.packing.cell->length[a]);
    EXPECT_EQ(initial_disks(scene, 3).packing.bodies.position, s.packing.bodies.position);
    EXPECT_NE(initial_disks(scene, 4).packing.bodies.position, s.packing.bodies.position);
  }
}

TEST(PushApart, TwoSizesAndAWidePowerLaw) {
  Scene scene = disks(0.81, 400);
  scene.law.attraction = 0;
  scene.grains.sizes = SizeLaw::bidisperse, scene.grains.diameter_min = 1 / 1.4;
  EXPECT_GT(smallest_gap(initial_disks(scene, 1).packing), 0);
  scene.grains.sizes = SizeLaw::power_law, scene.grains.exponent = 3, scene.grains.diameter_min = 0.1;
  EXPECT_GT(smallest_gap(initial_disks(scene, 1).packing), 0);
}

TEST(PushApart, SpheresUpToClosePacking) {
  for (const double solid_fraction : {0.37, 0.5, 0.62}) {
    const State<Spheres> s = initial_spheres(spheres(solid_fraction, 300), 3);
    double volume = 0;
    for (const double r : s.packing.bodies.radius) volume += 4 * std::numbers::pi / 3 * r * r * r;
    EXPECT_NEAR(volume / s.packing.cell->measure(), solid_fraction, 1e-12);
    EXPECT_GT(smallest_gap(s.packing), 0) << solid_fraction;
  }
}

TEST(PushApart, WhatJamsIsRefused) {
  for (const int count : {1, 2, 300}) {
    const auto refused = [&](const auto& begin) {
      try {
        begin();
      } catch (const InputError& e) {
        EXPECT_THAT(e.what(), ::testing::HasSubstr("grains.solid_fraction"));
        EXPECT_THAT(e.what(), ::testing::HasSubstr("jam"));
        return true;
      }
      return false;
    };
    EXPECT_TRUE(refused([&] { (void)initial_disks(disks(0.93, count), 1); })) << count;
    EXPECT_TRUE(refused([&] { (void)initial_spheres(spheres(0.76, count), 1); })) << count;
  }
}

}  // namespace
}  // namespace isostat
