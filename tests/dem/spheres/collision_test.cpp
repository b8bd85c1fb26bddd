// Two spheres against the closed forms of Hertz and of Tsuji's damping.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dem/spheres/engine.hpp"
#include "tests/support/sphere_states.hpp"

namespace isostat {
namespace {

constexpr double kRadiusI = 0.5, kRadiusJ = 0.3, kModulus = 1e5, kPoisson = 0.3;

struct Collision {
  double reduced_mass = 0, duration = 0, largest_overlap = 0, restitution = 0;
};

SphereLaw bare_law(NormalForce normal) {
  SphereLaw law;
  law.normal = normal;
  if (normal == NormalForce::hertz) law.grain = law.wall = {kModulus, kPoisson};
  if (normal == NormalForce::linear) law.normal_stiffness = kModulus;
  return law;
}

// Along an oblique line, from just before the contact to just after it; v is the speed of approach.
Collision collide(const SphereLaw& law, double v, double time_step) {
  State<Spheres> s;
  const Vec3 n{{2.0 / 3, -1.0 / 3, 2.0 / 3}};
  oracle::add_sphere(s.packing, kRadiusI, {}, (0.4 * v) * n);
  oracle::add_sphere(s.packing, kRadiusJ, (kRadiusI + kRadiusJ + 1e-9) * n, (-0.6 * v) * n);
  s.law = law, s.time_step = time_step;
  const double mi = s.packing.bodies.mass[0], mj = s.packing.bodies.mass[1];
  Collision c;
  c.reduced_mass = mi * mj / (mi + mj);
  Solver solver(s, {}, {});
  double last_gap = 1e-9, begin = -1;
  for (int k = 0; k < 10000000; ++k) {
    solver.step();
    solver.snapshot(s);
    const double gap = norm(s.packing.bodies.position[1] - s.packing.bodies.position[0]) - kRadiusI - kRadiusJ;
    const double crossing = s.time - time_step * gap / (gap - last_gap);
    c.largest_overlap = std::max(c.largest_overlap, -gap);
    if (gap < 0 && last_gap >= 0) begin = crossing;
    if (gap >= 0 && last_gap < 0) {
      c.duration = crossing - begin;
      break;
    }
    last_gap = gap;
  }
  c.restitution = norm(s.packing.bodies.velocity[1] - s.packing.bodies.velocity[0]) / v;
  return c;
}

TEST(SphereCollision, IsHertzs) {
  const double e = kModulus / (2 * (1 - kPoisson * kPoisson)), r = kRadiusI * kRadiusJ / (kRadiusI + kRadiusJ);
  for (const double v : {0.1, 1.0, 3.0}) {
    const double m = collide(bare_law(NormalForce::hertz), v, 1e-3).reduced_mass;
    const double overlap = std::pow(15.0 / 16 * m * v * v / (e * std::sqrt(r)), 0.4);
    const double duration = 2.868 * std::pow(m * m / (r * e * e * v), 0.2);
    const Collision fine = collide(bare_law(NormalForce::hertz), v, duration / 400);
    EXPECT_NEAR(fine.duration, duration, 2e-4 * duration);
    EXPECT_NEAR(fine.largest_overlap, overlap, 1e-4 * overlap);
    EXPECT_NEAR(fine.restitution, 1, 1e-4);
    const Collision coarse = collide(bare_law(NormalForce::hertz), v, duration / 40);
    EXPECT_NEAR(coarse.restitution, 1, 1e-2);
    EXPECT_LT(std::abs(fine.restitution - 1), 0.02 * std::abs(coarse.restitution - 1) + 1e-9);
  }
}

// e = exp(-pi b/sqrt(1 - b^2)) with b = sqrt(6/5) zeta, at every speed: b = alpha/sqrt(5) of Tsuji, Tanaka, Ishida
// 1992, eta = alpha sqrt(m 4/3 E* sqrt(R*)) d^(1/4), where the contact ends with the overlap (Antypov and Elliott
// 2011).
TEST(SphereCollision, LosesTheSamePartAtEverySpeed) {
  for (const double zeta : {0.05, 0.3, 0.6})
    for (const double v : {0.1, 1.0, 3.0}) {
      SphereLaw law = bare_law(NormalForce::hertz);
      law.damping = zeta;
      const double b = std::sqrt(1.2) * zeta, e = std::exp(-std::numbers::pi * b / std::sqrt(1 - b * b));
      EXPECT_NEAR(collide(law, v, 1e-5).restitution, e, 2e-4) << "zeta " << zeta << ", v " << v;
    }
}

TEST(SphereCollision, OfTheLinearLawHasAHalfPeriod) {
  SphereLaw law = bare_law(NormalForce::linear);
  const Collision c = collide(law, 1, 1e-5);
  EXPECT_NEAR(c.duration, std::numbers::pi * std::sqrt(c.reduced_mass / kModulus), 1e-5 * c.duration + 1e-7);
  EXPECT_NEAR(c.restitution, 1, 1e-3);
  law.damping = 0.3;
  const double b = law.damping, e = std::exp(-std::numbers::pi * b / std::sqrt(1 - b * b));
  EXPECT_NEAR(collide(law, 1, 1e-6).restitution, e, 1e-3);
}

}  // namespace
}  // namespace isostat
