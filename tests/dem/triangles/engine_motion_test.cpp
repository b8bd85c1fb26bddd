// How the engine moves grains: modes with closed forms, the orders of both integrators, energy without dampers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dem/triangles/energy.hpp"
#include "dem/triangles/engine.hpp"
#include "dem/triangles/grain_shape.hpp"
#include "dem/triangles/grain_spectrum.hpp"
#include "dem/triangles/sample.hpp"
#include "geometry/base/index.hpp"
#include "tests/support/moving_triangles.hpp"

namespace isostat {
namespace {

constexpr double kSide = 0.14;  // [cm]

// One square about the origin, at rest and without load.
State<TriangleGrains> one_square(double damping, double step_in_omega, Integrator integrator = Integrator::verlet) {
  State<TriangleGrains> s;
  s.scene = default_scene(SceneSystem::triangles);
  s.scene.step.integrator = integrator;
  TriangleLawScene law;
  law.damping = damping;
  s.law = resolve(law);
  const GrainTemplate square = grain_template(grain_shape("square", kSide), {});
  append_grain(s.packing, square, {}, 0, GrainPart::free, 0);
  s.time_step = step_in_omega / grain_frequencies(square).back();
  return s;
}

// PHYSICS 2: all four triangles move out and back, omega_0 = sqrt(2 E/m), amplitude as exp(-gamma t/m).
TEST(EngineMotion, BreathingModeHasItsFrequencyAndDecay) {
  const double mass = kSide * kSide / 4, omega0 = std::sqrt(2e5 / mass);
  for (const double gamma : {0.0, 1.0, 9.0}) {
    for (const Integrator integrator : {Integrator::verlet, Integrator::gear}) {
      State<TriangleGrains> s = one_square(gamma, 0.01, integrator);
      const double amplitude = 1e-4 * kSide, rest = norm(s.packing.bodies.position[0]);
      for (Vec2& r : s.packing.bodies.position) r = (1 + amplitude / rest) * r;
      const double decay = gamma / mass, omega = std::sqrt(omega0 * omega0 - decay * decay);
      Solver<TriangleGrains> solver(s, {});
      double worst = 0, seen = 0;
      while (solver.time() < 12 / omega0) {
        solver.step();
        solver.snapshot(s);
        const double t = s.time, is = norm(s.packing.bodies.position[2]) - rest;
        const double expected =
            amplitude * std::exp(-decay * t) * (std::cos(omega * t) + decay / omega * std::sin(omega * t));
        worst = std::max(worst, std::abs(is - expected)), seen = std::min(seen, is);
      }
      EXPECT_LT(worst, 1e-3 * amplitude) << gamma;
      EXPECT_LT(seen, -amplitude * (gamma > 1 ? 0.2 : 0.8)) << gamma;  // it did swing through
    }
  }
}

// PHYSICS 2: omega^2 = (12 EI/L) 27/(m s^2); all triangles turn alike, the ring turns back.
TEST(EngineMotion, SpinModeHasItsFrequency) {
  for (const Integrator integrator : {Integrator::verlet, Integrator::gear}) {
    State<TriangleGrains> s = one_square(0, 0.02, integrator);
    const double m = kSide * kSide / 4, arm = kSide / 3, length = std::numbers::sqrt2 * arm;
    const double omega = std::sqrt(12 * 10 / length * 27 / (m * kSide * kSide)), spin = 1e-5 * omega;
    Bodies<2>& b = s.packing.bodies;
    std::fill(b.spin.begin(), b.spin.end(), spin);
    const double back = -b.inertia[0] * spin / (m * arm * arm);  // angular momentum of the whole is zero
    for (std::size_t k = 0; k < 4; ++k) b.velocity[k] = {{-back * b.position[k][1], back * b.position[k][0]}};
    Solver<TriangleGrains> solver(s, {});
    double worst = 0;
    while (omega * solver.time() < 20) {
      solver.step();
      solver.snapshot(s);
      worst = std::max(worst, std::abs(s.packing.angle[1] * omega / spin - std::sin(omega * s.time)));
    }
    EXPECT_LT(worst, 1e-3);
  }
}

// A square knocked out of shape and turning, dampers on: nothing but smooth forces.
State<TriangleGrains> shaken_square(double damping, double step_in_omega, Integrator integrator) {
  State<TriangleGrains> s = one_square(damping, step_in_omega, integrator);
  Bodies<2>& b = s.packing.bodies;
  for (std::size_t k = 0; k < 4; ++k) {
    const double phase = 1.3 * static_cast<double>(k * k);
    b.velocity[k] = {{20 * std::sin(phase) - 100 * b.position[k][1], 20 * std::cos(phase) + 100 * b.position[k][0]}};
    b.spin[k] = 100 + 300 * std::cos(2 * phase);
  }
  return s;
}

double distance(const State<TriangleGrains>& a, const State<TriangleGrains>& b) {
  double largest = 0;
  for (std::size_t k = 0; k < a.packing.bodies.size(); ++k)
    largest = std::max({largest, norm(a.packing.bodies.position[k] - b.packing.bodies.position[k]) / kSide,
                        std::abs(a.packing.angle[k] - b.packing.angle[k])});
  return largest;
}

State<TriangleGrains> marched(State<TriangleGrains> s, std::int64_t steps) {
  Solver<TriangleGrains> solver(s, {});
  solver.run(steps);
  solver.snapshot(s);
  return s;
}

TEST(EngineMotion, VerletIsOfSecondOrder) {
  for (const double damping : {0.0, 9.0}) {
    const auto at = [&](std::int64_t steps) {
      return marched(shaken_square(damping, 12.8 / static_cast<double>(steps), Integrator::verlet), steps);
    };
    const State<TriangleGrains> exact = at(65536);
    const double coarse = distance(at(64), exact), middle = distance(at(128), exact), fine = distance(at(256), exact);
    EXPECT_NEAR(coarse / middle, 4, 0.4) << damping;
    EXPECT_NEAR(middle / fine, 4, 0.2) << damping;
    EXPECT_GT(fine, 1e-8) << damping;
  }
}

// From a run in progress, so that all its derivatives are there: those of a longer step k h are k^3, k^4 times as
// large.
TEST(EngineMotion, GearIsOfFourthOrder) {
  for (const double damping : {0.0, 9.0}) {
    constexpr double kStep = 12.8 / 4096;
    const State<TriangleGrains> start = marched(shaken_square(damping, kStep, Integrator::gear), 400);
    const auto at = [&](std::int64_t every) {
      State<TriangleGrains> s = start;
      const double k = static_cast<double>(every);
      s.time_step *= k, s.memory.lists = {};
      for (auto& d : s.memory.derivatives) d[0] = k * k * k * d[0], d[1] = k * k * k * k * d[1];
      for (auto& d : s.memory.spin_derivatives) d[0] *= k * k * k, d[1] *= k * k * k * k;
      return marched(s, 4096 / every);
    };
    const State<TriangleGrains> exact = at(1);
    const double coarse = distance(at(64), exact), middle = distance(at(32), exact), fine = distance(at(16), exact);
    EXPECT_GT(coarse / middle, 12) << damping << " " << coarse << " " << middle << " " << fine;
    EXPECT_GT(middle / fine, 12) << damping << " " << coarse << " " << middle << " " << fine;
    EXPECT_LT(coarse, 1e-2);
  }
}

// Without dampers the energy of one grain swings with the square of Verlet's step and does not drift.
TEST(EngineMotion, KeepsTheEnergyOfAGrain) {
  double last = 0;
  for (const double step : {0.4, 0.2, 0.1}) {
    State<TriangleGrains> s = shaken_square(0, step, Integrator::verlet);
    const double start = energies(s).total();
    Solver<TriangleGrains> solver(s, {});
    double swing = 0;
    for (int k = 0; k < static_cast<int>(4000 / step); k += 7) {
      solver.run(7);
      solver.snapshot(s);
      swing = std::max(swing, std::abs(energies(s).total() / start - 1));
    }
    EXPECT_LT(swing, 0.2 * step * step) << step;
    if (last > 0) {
      EXPECT_NEAR(last / swing, 4, 0.5) << step;
    }
    last = swing;
  }
}

// A dense crowd in a cell, without dampers: what overlap-energy takes in an overlap it gives back. TRIANGLES.md 5:
// forces have corners where edges pass each other, so what is lost falls with the step, about as its first power.
TEST(EngineMotion, KeepsTheEnergyOfACrowd) {
  double last = 0;
  for (const double step : {0.4, 0.1, 0.025}) {
    oracle::MovingTriangles m;
    m.count = 30, m.law.damping = 0, m.step_fraction = step;
    State<TriangleGrains> s = moving_triangles(m);
    const double start = energies(s).total();
    Solver<TriangleGrains> solver(s, {});
    double drift = 0;
    std::size_t met = 0;
    while (solver.time() < 4e-3) {
      solver.run(20);
      solver.snapshot(s);
      drift = std::max(drift, std::abs(energies(s).total() / start - 1));
      met = std::max(met, s.packing.overlaps.size());
    }
    EXPECT_GT(met, 10u);
    if (last > 0) {
      EXPECT_LT(drift, 0.5 * last) << step;
    }
    last = drift;
  }
  EXPECT_LT(last, 1e-4);
}

}  // namespace
}  // namespace isostat
