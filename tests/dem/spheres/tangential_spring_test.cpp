// The tangential spring of one contact that is led along given paths, against closed forms.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "dem/solver/neighbours.hpp"
#include "dem/solver/random.hpp"
#include "dem/spheres/pairs.hpp"
#include "tests/support/sphere_states.hpp"

namespace isostat {
namespace {

// Two spheres, the second of which is moved and turned; forces by the kernel.
class LedPair {
 public:
  LedPair(const SphereLaw& law, const Vec3& branch) : law_(law), columns_(law) {
    bodies_.resize(2);
    for (std::size_t k = 0; k < 2; ++k) {
      const double radius = k == 0 ? 0.5 : 0.3, mass = 8 * radius * radius * radius;
      bodies_.constants[k] = {1 / mass, 2.5 / (mass * radius * radius), radius, mass};
    }
    bodies_.place(1, branch);
    columns_.resize(kPairBatch);
    columns_.fill(0, bodies_, 0, 1);
    i_.assign(kPairBatch, offset(2)), j_.assign(kPairBatch, offset(3)), i_[0] = offset(0), j_[0] = offset(1);
    shift_.assign(kPairBatch, kNoImage<3>);
    kernel_ = spheres::select_kernel(law, spheres::Tally::nothing, best_isa());
    step({}, {}, {});
  }
  // Displacement of the second sphere, and rotations of both, in one step of unit time.
  void step(const Vec3& moved, const Vec3& turned_i, const Vec3& turned_j) {
    bodies_.place(1, bodies_.position(1) + moved);
    bodies_.set_half_velocity(1, moved);
    bodies_.set_half_spin(0, turned_i), bodies_.set_half_spin(1, turned_j);
    std::fill(bodies_.loads.begin(), bodies_.loads.end(), 0.0);
    spheres::PairForceInput in;
    in.rows = bodies_.rows.data(), in.spins = bodies_.spins.data();
    in.loads = bodies_.loads.data(), in.moments = bodies_.moments.data();
    in.pairs = columns_.arrays(i_.data(), j_.data(), shift_.data());
    in.law = law_, in.time_step = 1, in.end = kPairBatch;
    const ContactStiffness unit = pair_stiffness(law_, 1, 1);
    in.tangential_ratio = unit.tangential / unit.normal;
    kernel_(in);
  }
  double gap() const { return norm(bodies_.position(1)) - bodies_.radius(0) - bodies_.radius(1); }
  Vec3 branch() const { return bodies_.position(1); }
  Vec3 spring() const { return columns_.history(0).tangential_force; }
  Vec3 moment() const { return columns_.history(0).moment; }
  void set_springs(const Vec3& t, const Vec3& m) { columns_.remember(0, {t, m}); }
  double lever_j() const { return norm(branch()) * bodies_.radius(1) / (bodies_.radius(0) + bodies_.radius(1)); }
  ContactStiffness stiffness() const { return pair_stiffness(law_, bodies_.radius(0), bodies_.radius(1)); }
  double stiffness_now() const { return tangential_stiffness(law_, stiffness(), gap()); }
  double limit() const { return law_.friction * repulsion(law_, stiffness(), gap()); }

 private:
  static std::uint32_t offset(std::size_t body) { return static_cast<std::uint32_t>(body * spheres::kRowWidth); }
  SphereLaw law_;
  SphereStore bodies_;
  SpherePairs columns_;
  AlignedVector<std::uint32_t> i_, j_;
  AlignedVector<std::uint8_t> shift_;
  spheres::PairForceKernel kernel_;
};

SphereLaw friction_law(NormalForce normal, double friction = 0.3) {
  SphereLaw law = oracle::soft_sphere_law(normal);
  law.attraction = law.attraction_range = law.rolling_friction = law.rolling_stiffness = 0;
  law.damping = law.tangential_damping = 0, law.friction = friction;
  return law;
}

// Turned under a constant load: T = k_T u up to mu N; backwards along the same slope to -mu N.
TEST(TangentialSpring, LoadsAndUnloadsAlongKT) {
  for (const NormalForce normal : {NormalForce::hertz, NormalForce::linear}) {
    LedPair pair(friction_law(normal), {{0, 0, 0.79}});
    const double k = pair.stiffness_now(), limit = pair.limit(), du = 0.01 * limit / k;
    // A turn about y by dw moves the surface of j at the contact, below its centre, along -x.
    const auto shear = [&](double u) { pair.step({}, {}, {{0, -u / pair.lever_j(), 0}}); };
    double expected = 0;
    for (int n = 0; n < 150; ++n) {
      shear(du);
      expected = std::max(-limit, expected - k * du);
      ASSERT_NEAR(pair.spring()[0], expected, 1e-12 * limit) << n;
      ASSERT_NEAR(pair.spring()[1], 0, 1e-14 * limit);
    }
    EXPECT_DOUBLE_EQ(expected, -limit);
    for (int n = 0; n < 300; ++n) {
      shear(-du);
      expected = std::min(limit, expected + k * du);
      ASSERT_NEAR(pair.spring()[0], expected, 1e-12 * limit) << n;
    }
    EXPECT_DOUBLE_EQ(expected, limit);
  }
}

// Whatever path overlap and shear take, the work put in is at least what the spring holds.
TEST(TangentialSpring, NeverGivesBackMoreThanWentIn) {
  for (const double friction : {0.3, 1e3}) {
    double dissipated = 0, released = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      Random random(seed);
      LedPair pair(friction_law(NormalForce::hertz, friction), {{0, 0, 0.78}});
      const double scale = 1e-3;
      double work = 0, depth_rate = 0, most = 0;
      std::array<double, 2> rate{};
      for (int n = 0; n < 4000; ++n) {
        if (n % 200 == 0) {
          depth_rate = scale * 0.05 * (random.uniform() - 0.5), rate[0] = scale * 0.05 * (random.uniform() - 0.5);
          rate[1] = scale * 0.05 * (random.uniform() - 0.5);
        }
        if (pair.gap() > -0.01) depth_rate = -std::abs(depth_rate);
        if (pair.gap() < -0.03) depth_rate = std::abs(depth_rate);
        const Vec3 before = pair.spring();
        pair.step({{0, 0, depth_rate}}, {}, {{rate[1] / pair.lever_j(), -rate[0] / pair.lever_j(), 0}});
        const Vec3 mean = 0.5 * (before + pair.spring());
        work -= mean[0] * rate[0] + mean[1] * rate[1];
        const double held = dot(pair.spring(), pair.spring()) / (2 * pair.stiffness_now());
        most = std::max(most, held);
        ASSERT_GE(work - held, -2e-3 * most) << "seed " << seed << ", step " << n;  // of first order in the step
        released = std::max(released, most - held);
      }
      dissipated += work;
    }
    EXPECT_GT(dissipated, 0);
    EXPECT_GT(released, 0);
  }
}

// A rigid rotation about any axis, many steps: both springs turn with it and keep their size.
TEST(TangentialSpring, TurnsWithARigidRotation) {
  SphereLaw law = friction_law(NormalForce::hertz, 10);
  law.rolling_friction = 10, law.rolling_stiffness = 30;
  for (const Vec3& axis : {Vec3{{0, 0, 1}}, Vec3{{0, 1, 0}}, Vec3{{0.6, 0, 0.8}}, Vec3{{2.0 / 3, 2.0 / 3, -1.0 / 3}}}) {
    std::array<double, 2> error{};
    for (const int fine : {0, 1}) {
      LedPair pair(law, {{0, 0, 0.78}});
      const Vec3 t{{0.4, 0.3, 0}}, m{{0.1, -0.3, 0.2}};
      pair.set_springs(t, m);
      const double angle = 1e-3 / (1 + fine);
      const int steps = 3000 * (1 + fine);
      const auto turned = [&](const Vec3& v, double by) {
        return std::cos(by) * v + std::sin(by) * cross(axis, v) + ((1 - std::cos(by)) * dot(axis, v)) * axis;
      };
      const Vec3 start = pair.branch();
      for (int n = 1; n <= steps; ++n) pair.step(turned(start, n * angle) - pair.branch(), angle * axis, angle * axis);
      EXPECT_NEAR(norm(pair.spring()), norm(t), 1e-5);
      EXPECT_NEAR(norm(pair.moment()), norm(m), 1e-10);
      error[fine] = norm(pair.spring() - turned(t, steps * angle)) + norm(pair.moment() - turned(m, steps * angle));
      EXPECT_LT(error[fine], 2e-4 / (1 + 3 * fine));
    }
    EXPECT_LT(error[1], 0.3 * error[0] + 1e-9);  // of second order
  }
}

}  // namespace
}  // namespace isostat
