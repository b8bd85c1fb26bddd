// Two disks that collide at an offset, the twin of squares_collision_test.cpp: closed forms, and what the scene
// refuses.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dem/disks/check.hpp"
#include "dem/disks/sample.hpp"
#include "dem/run/stages.hpp"
#include "dem/scene/check.hpp"
#include "dem/scene/file.hpp"

namespace isostat {
namespace {

State<Disks> collided(double speed, double friction) {
  Scene scene = read_scene(std::string(ISOSTAT_DATA) + "/scenes/disks-collision.toml");
  scene.grains.speed = speed, scene.law.friction = friction;
  scene.stages[0].max_time = 1000;
  State<Disks> s = initial_disks(scene, 1);
  const RunOutcome outcome = run_stages(s, {}, {});
  EXPECT_TRUE(outcome.all_met()) << outcome.stages.back().reason;
  return s;
}

double translation(const State<Disks>& s) {
  double sum = 0;
  for (const Vec2& v : s.packing.bodies.velocity) sum += 0.5 * dot(v, v);
  return sum;
}

// The normal part of the relative velocity, cos^2 = 1 - 1/4 of its square, is returned with e^2; nothing turns.
TEST(DisksCollision, WithoutFrictionNothingTurnsAtAnySpeed) {
  const double zeta = 0.2, e = std::exp(-std::numbers::pi * zeta / std::sqrt(1 - zeta * zeta));
  for (const double speed : {0.1, 1.0, 10.0}) {
    const State<Disks> s = collided(speed, 0);
    EXPECT_NEAR(translation(s) / (0.5 * speed * speed), 1 - 0.75 * (1 - e * e) / 2, 2e-3) << speed;
    EXPECT_EQ(s.packing.bodies.spin, (std::vector<double>{0, 0}));
  }
}

// With friction both turn alike, and angular momentum is kept.
TEST(DisksCollision, WithFrictionTheyTurnAlike) {
  const State<Disks> s = collided(1, 0.5);
  const Bodies<2>& b = s.packing.bodies;
  EXPECT_LT(b.spin[0], -0.1);
  EXPECT_NEAR(b.spin[0], b.spin[1], 1e-12);
  double turning = 0;
  for (std::size_t k = 0; k < 2; ++k)
    turning += b.mass[k] * (b.position[k][0] * b.velocity[k][1] - b.position[k][1] * b.velocity[k][0]) +
               b.inertia[k] * b.spin[k];
  EXPECT_NEAR(turning, -0.5, 1e-4);
}

TEST(DisksCollision, IsRefusedWhereItHasNoPlace) {
  const Scene scene = read_scene(std::string(ISOSTAT_DATA) + "/scenes/disks-collision.toml");
  const auto refused = [](const Scene& s) {
    std::string keys;
    for (const SceneConflict& c : surroundings_conflicts(s)) keys += c.key + " ";
    return keys;
  };
  EXPECT_EQ(refused(scene), "");
  Scene bad = scene;
  bad.container.shape = ContainerShape::box;
  EXPECT_EQ(refused(bad), "grains.arrangement ");
  bad = scene, bad.stages[0].pressure = 1;
  EXPECT_EQ(refused(bad), "stage.0.pressure ");
  bad = scene, bad.grains.arrangement = Arrangement::random;
  EXPECT_EQ(refused(bad), "stage.0.until ");
}

}  // namespace
}  // namespace isostat
