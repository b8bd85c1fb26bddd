// The stable step of a grain: known limits, TRIANGLES.md 5, and a reference integrator just below and above it.
#include "dem/triangles/stable_step.hpp"

#include <gtest/gtest.h>

#include "dem/input_error.hpp"
#include "dem/triangles/gear_scheme.hpp"
#include "dem/triangles/grain_shape.hpp"
#include "dem/triangles/grain_spectrum.hpp"
#include "tests/dem/triangles/moving_grain.hpp"

namespace isostat {
namespace {

GrainTemplate grain_of(const char* shape, double size, double damping = 9) {
  GrainMaterial material;
  material.damping = damping;
  return grain_template(grain_shape(shape, size), material);
}

TEST(StableStep, WithoutDampersVerletReachesTwoOverTheLargestFrequency) {
  for (const char* shape : {"square", "polygon6", "rod", "star"}) {
    const GrainTemplate grain = grain_of(shape, 0.1, 0);
    const double omega = grain_frequencies(grain).back();
    const StableStep step = stable_step(grain);
    EXPECT_NEAR(step.verlet * omega, 2, 1e-5) << shape;
    EXPECT_NEAR(step.gear * omega, 0.3485, 1e-4) << shape;  // a growth of 1e-4 a step, 0.06 (omega dt)^6
  }
}

TEST(StableStep, NoBeamsNoLimit) {
  const StableStep step = stable_step(grain_of("triangle", 0.1));
  EXPECT_TRUE(std::isinf(step.gear) && std::isinf(step.verlet));
}

// TRIANGLES.md 5, beds of squares of which the smallest has this side, gamma 9: Gear .34 and .15, Verlet 1.30 and .75,
// in 1/omega of the smallest grain's spin mode. Free grains have no contacts, and the smallest of a bed is a little
// larger than the bound.
TEST(StableStep, BesideTheMeasuredBeds) {
  const double omega = grain_frequencies(grain_of("square", 0.1)).back();
  const StableStep step = stable_step(grain_of("square", 0.1));
  EXPECT_NEAR(step.gear * omega, 0.34, 0.01);
  EXPECT_NEAR(step.verlet * omega, 1.30, 0.08);
  const double small_omega = grain_frequencies(grain_of("square", 0.07)).back();
  const StableStep small = stable_step(grain_of("square", 0.07));
  EXPECT_NEAR(small.gear * small_omega, 0.15, 0.005);
  EXPECT_NEAR(small.verlet * small_omega, 0.75, 0.06);
}

// Without dampers all times scale as s^2.5 with the side of a square of bending beams.
TEST(StableStep, ScalesAsTheSizeToFiveHalves) {
  const double ratio = stable_step(grain_of("square", 0.05, 0)).verlet / stable_step(grain_of("square", 0.1, 0)).verlet;
  EXPECT_NEAR(ratio, std::pow(0.5, 2.5), 1e-6);
}

TEST(StableStep, RefusesGrainsTooLargeForIt) {
  GrainTemplate grain = grain_of("square", 0.1);
  grain.triangles.resize(kMostTrianglesOfAStep + 1);
  EXPECT_THROW(stable_step(grain), InputError);
}

// All forces and the true motion, not linearised. Each integrator as stable_step.hpp describes it.
class Verlet {
 public:
  Verlet(const GrainTemplate& grain, Coordinates x, Coordinates v, double dt, SpinInDampers spin)
      : grain_(grain), x_(std::move(x)), v_(std::move(v)), a_(x_.size(), 0.0), dt_(dt), spin_(spin) {}
  void step() {
    const Coordinates elastic = elastic_forces(grain_, x_);
    Coordinates seen = sum(v_, a_, dt_ / 2);
    Coordinates viscous = damper_forces(grain_, x_, seen);
    std::vector<double> own(x_.size(), 0.0);  // torque on a body per its own spin
    for (const GrainBeam& b : grain_.beams)
      for (const std::int32_t t : {b.i, b.j})
        own[3 * idx(t) + 2] += grain_.material.damping * b.beam.bending / b.beam.stiffness / b.beam.rest_length;
    Coordinates a(x_.size());
    for (std::size_t d = 2; d < a.size(); d += 3) {  // spins: their mean over the step in place of what was seen
      const double rest = elastic[d] + viscous[d] + own[d] * seen[d];
      a[d] = (rest - own[d] * v_[d]) / (inertia_of(grain_, d) + own[d] * dt_ / 2);
      if (spin_ == SpinInDampers::torque_and_force) seen[d] = v_[d] + a[d] * dt_ / 2;
    }
    if (spin_ == SpinInDampers::torque_and_force) viscous = damper_forces(grain_, x_, seen);
    for (std::size_t d = 0; d < a.size(); ++d)
      if (d % 3 != 2) a[d] = (elastic[d] + viscous[d]) / inertia_of(grain_, d);
    a_ = a;
    v_ = sum(v_, a_, dt_);
    x_ = sum(x_, v_, dt_);
  }
  double total_energy() const { return kinetic_energy(grain_, v_) + energy(grain_, x_); }
  double angular_momentum() const {  // of the half step: x(n) and x(n+1) give the same with v(n+1/2)
    Coordinates p = v_;
    for (std::size_t d = 0; d < p.size(); ++d) p[d] *= inertia_of(grain_, d);
    return resultant(x_, p)[2];
  }

 private:
  const GrainTemplate& grain_;
  Coordinates x_, v_, a_;
  double dt_;
  SpinInDampers spin_;
};

class Gear {
 public:
  Gear(const GrainTemplate& grain, const Coordinates& x, const Coordinates& v, double dt) : grain_(grain), dt_(dt) {
    value_ = {x, sum(Coordinates(x.size(), 0.0), v, dt)};
    const Coordinates elastic = elastic_forces(grain, x), viscous = damper_forces(grain, x, v);
    value_.resize(5, Coordinates(x.size(), 0.0));
    for (std::size_t d = 0; d < x.size(); ++d)
      value_[2][d] = (elastic[d] + viscous[d]) / inertia_of(grain, d) * dt * dt / 2;
  }
  void step() {
    for (std::size_t k = 0; k < 5; ++k)
      for (std::size_t l = k + 1; l < 5; ++l) value_[k] = sum(value_[k], value_[l], kGearPredictor[k][l]);
    const Coordinates v = sum(Coordinates(value_[1].size(), 0.0), value_[1], 1 / dt_);
    const Coordinates elastic = elastic_forces(grain_, value_[0]), viscous = damper_forces(grain_, value_[0], v);
    Coordinates error(v.size());
    for (std::size_t d = 0; d < v.size(); ++d)
      error[d] = (elastic[d] + viscous[d]) / inertia_of(grain_, d) * dt_ * dt_ / 2 - value_[2][d];
    for (std::size_t k = 0; k < 5; ++k) value_[k] = sum(value_[k], error, kGearCorrector[k]);
  }
  double total_energy() const {
    return kinetic_energy(grain_, sum(Coordinates(value_[1].size(), 0.0), value_[1], 1 / dt_)) +
           energy(grain_, value_[0]);
  }

 private:
  const GrainTemplate& grain_;
  std::vector<Coordinates> value_;
  double dt_;
};

// Energy after many steps over that at the start, of a small random deformation; stops once the answer is clear.
template <class Integrator>
double growth(Integrator integrator) {
  const double start = integrator.total_energy();
  double ratio = 1;
  for (int k = 0; k < 6000 && ratio < 1e4; ++k) {
    integrator.step();
    ratio = integrator.total_energy() / start;
    if (!std::isfinite(ratio)) return 1e9;
  }
  return ratio;
}

TEST(StableStep, SeparatesDecayFromGrowth) {
  constexpr double kBelow = 0.985, kAbove = 1.015;
  for (const auto& [shape, size] :
       {std::pair{"square", 0.1}, {"square", 0.07}, {"polygon5", 0.1}, {"rod", 0.2}, {"L", 0.2}, {"star", 0.3}}) {
    const GrainTemplate grain = grain_of(shape, size);
    const Coordinates x = sum(as_built(grain), random_motion(grain, 1e-7, 11)), v(x.size(), 0.0);
    for (const SpinInDampers spin : {SpinInDampers::torque, SpinInDampers::torque_and_force}) {
      const StableStep limit = stable_step(grain, spin);
      EXPECT_LT(growth(Verlet(grain, x, v, kBelow * limit.verlet, spin)), 1) << shape << size;
      EXPECT_GT(growth(Verlet(grain, x, v, kAbove * limit.verlet, spin)), 1e4) << shape << size;
      if (spin != SpinInDampers::torque) continue;
      EXPECT_LT(growth(Gear(grain, x, v, kBelow * limit.gear)), 1) << shape << size;
      EXPECT_GT(growth(Gear(grain, x, v, kAbove * limit.gear)), 1e4) << shape << size;
    }
  }
}

// No step below the limit is unstable.
TEST(StableStep, IsTheFirstFromBelow) {
  const GrainTemplate grain = grain_of("square", 0.1);
  const Coordinates x = sum(as_built(grain), random_motion(grain, 1e-7, 12)), v(x.size(), 0.0);
  const StableStep limit = stable_step(grain);
  for (double part = 0.05; part < 1; part += 0.05) {
    EXPECT_LT(growth(Verlet(grain, x, v, part * limit.verlet, SpinInDampers::torque)), 1) << part;
    EXPECT_LT(growth(Gear(grain, x, v, part * limit.gear)), 1) << part;
  }
}

// What the two readings of "own spin implicit" differ in: with the mean spin in the torque alone the dampers of a step
// do not balance, by D (a(n) - a(n-1)) dt/2. The sum of that over steps is bounded and dies away with the motion.
TEST(StableStep, AngularMomentumNeedsTheSameSpinInTorqueAndForce) {
  const GrainTemplate grain = grain_of("square", 0.1);
  const double dt = 0.6 / grain_frequencies(grain).back();
  const Coordinates x = as_built(grain), v = random_motion(grain, 100, 13);
  const auto largest_change = [&](SpinInDampers spin) {
    Verlet integrator(grain, x, v, dt, spin);
    const double start = integrator.angular_momentum();
    double largest = 0;
    for (int k = 0; k < 300; ++k) {
      integrator.step();
      largest = std::max(largest, std::abs(integrator.angular_momentum() - start));
    }
    return largest / (grain.inertia * 100);
  };
  EXPECT_LT(largest_change(SpinInDampers::torque_and_force), 1e-12);
  EXPECT_GT(largest_change(SpinInDampers::torque), 1e-3);
}

}  // namespace
}  // namespace isostat
