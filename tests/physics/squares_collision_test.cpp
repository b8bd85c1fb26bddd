// Two squares of four triangles collide (Poeschel and Buchholtz 1995, Sec. 6.1): side .14 cm, the left one .5 sides
// higher. PHYSICS 2 and TRIANGLES.md 5 have the values, of programs written apart from this one.
#include <gtest/gtest.h>

#include <cmath>

#include "dem/triangles/engine.hpp"
#include "dem/triangles/sample.hpp"
#include "dem/triangles/stage.hpp"
#include "geometry/base/index.hpp"
#include "tests/support/moving_triangles.hpp"

namespace isostat {
namespace {

constexpr double kSide = 0.14;  // [cm]

State<TriangleGrains> about_to_collide(ContactLaw contact, double speed, double step_in_omega, double damping = 9) {
  Scene scene = default_scene(SceneSystem::triangles);
  scene.triangle_grains.arrangement = Arrangement::collision;
  scene.triangle_grains.count = 2, scene.triangle_grains.size_max = kSide;
  scene.triangle_grains.speed = speed, scene.triangle_grains.offset = 0.5;
  scene.triangle_law.contact = contact, scene.triangle_law.damping = damping;
  scene.step.fraction = step_in_omega;
  return initial_triangles(scene, 1);
}

// Velocity of the centre and angular momentum over inertia of a grain as it is.
struct Motion {
  double mass = 0, inertia = 0, omega = 0;
  Vec2 velocity{};
};
Motion motion_of(const TrianglePacking& p, std::size_t g) {
  Motion m;
  Vec2 centre{};
  const auto begin = idx(p.grains.begin[g]), end = idx(p.grains.begin[g + 1]);
  for (std::size_t k = begin; k < end; ++k) {
    m.mass += p.bodies.mass[k];
    centre += p.bodies.mass[k] * p.bodies.position[k], m.velocity += p.bodies.mass[k] * p.bodies.velocity[k];
  }
  centre = (1 / m.mass) * centre, m.velocity = (1 / m.mass) * m.velocity;
  for (std::size_t k = begin; k < end; ++k) {
    const Vec2 r = p.bodies.position[k] - centre, v = p.bodies.velocity[k] - m.velocity;
    m.inertia += p.bodies.inertia[k] + p.bodies.mass[k] * dot(r, r);
    m.omega += p.bodies.inertia[k] * p.bodies.spin[k] + p.bodies.mass[k] * (r[0] * v[1] - r[1] * v[0]);
  }
  m.omega /= m.inertia;
  return m;
}

struct Outcome {
  double translation = 0, rotation = 0;  // [E0]
  double omega = 0;                      // [v/s] of either square
  double first_omega = 0;                // after the first contact
  Vec2 momentum_error{};
  double turning_error = 0;  // relative
};
Outcome collide(ContactLaw contact, double speed, double step_in_omega) {
  State<TriangleGrains> s = about_to_collide(contact, speed, step_in_omega);
  const Motion left = motion_of(s.packing, 0);
  const double energy = 0.5 * left.mass * speed * speed, turning = oracle::angular_momentum(s);
  const Vec2 momentum = oracle::momentum(s);
  Outcome out;
  Solver<TriangleGrains> solver(s, {});
  bool touched = false;
  double apart_since = -1;  // a rotating square hits a second time, or it is over after a quarter of a turn's time
  while (apart_since < 0 || solver.time() < apart_since + 3 * kSide / speed) {
    solver.run(4);
    solver.snapshot(s);
    const bool touching = !s.packing.overlaps.empty();
    if (touching) apart_since = -1;
    if (touched && !touching && apart_since < 0) {
      apart_since = s.time;
      if (out.first_omega == 0) out.first_omega = motion_of(s.packing, 0).omega * kSide / speed;
    }
    touched = touched || touching;
  }
  for (std::size_t g = 0; g < 2; ++g) {
    const Motion m = motion_of(s.packing, g);
    out.translation += 0.5 * m.mass * dot(m.velocity, m.velocity) / energy;
    out.rotation += 0.5 * m.inertia * m.omega * m.omega / energy;
    out.omega = m.omega * kSide / speed;
  }
  out.momentum_error = (1 / (left.mass * speed)) * (oracle::momentum(s) - momentum);
  out.turning_error = oracle::angular_momentum(s) / turning - 1;
  return out;
}

struct Expected {
  double speed, translation, rotation, omega;
};

TEST(SquaresCollision, ThePapersLaw) {
  for (const Expected& e :
       {Expected{10, .679, .016, -.218}, Expected{50, .657, .013, -.199}, Expected{70, .619, .034, -.321},
        Expected{100, .532, .151, -.671}, Expected{120, .524, .152, -.671}}) {
    const Outcome out = collide(ContactLaw::paper, e.speed, 0.02);
    EXPECT_NEAR(out.translation, e.translation, 0.003) << e.speed;
    EXPECT_NEAR(out.rotation, e.rotation, 0.003) << e.speed;
    EXPECT_NEAR(out.omega, e.omega, 0.003) << e.speed;
  }
}

TEST(SquaresCollision, TheLawWithAnEnergy) {
  for (const Expected& e :
       {Expected{10, .731, .010, -.171}, Expected{50, .525, .197, -.768}, Expected{100, .538, .159, -.689}}) {
    const Outcome out = collide(ContactLaw::overlap_energy, e.speed, 0.02);
    EXPECT_NEAR(out.translation, e.translation, 0.003) << e.speed;
    EXPECT_NEAR(out.rotation, e.rotation, 0.003) << e.speed;
    EXPECT_NEAR(out.omega, e.omega, 0.003) << e.speed;
  }
}

// v_tc: below it the squares hit a second time, which takes more than half of their rotation.
TEST(SquaresCollision, TransitionOfThePapersLaw) {
  double low = 65, high = 78;
  const auto keeps_rotating = [](double speed) {
    const Outcome out = collide(ContactLaw::paper, speed, 0.05);
    return std::abs(out.omega) > 0.5 * std::abs(out.first_omega);
  };
  ASSERT_FALSE(keeps_rotating(low));
  ASSERT_TRUE(keeps_rotating(high));
  while (high - low > 0.1) {
    const double middle = 0.5 * (low + high);
    (keeps_rotating(middle) ? high : low) = middle;
  }
  EXPECT_NEAR(0.5 * (low + high), 71.6, 0.5);
}

TEST(SquaresCollision, KeepsMomenta) {
  for (const ContactLaw contact : {ContactLaw::paper, ContactLaw::overlap_energy})
    for (const double speed : {10.0, 50.0, 120.0}) {
      const Outcome out = collide(contact, speed, 0.2);
      EXPECT_LT(norm(out.momentum_error), 1e-13) << speed;
      EXPECT_LT(std::abs(out.turning_error), 1e-8) << speed;
    }
}

}  // namespace
}  // namespace isostat
