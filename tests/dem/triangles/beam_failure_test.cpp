// Beams that break and yield: the event log, the grains that come of it, and what stays as it was.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "dem/triangles/at_rest.hpp"
#include "dem/triangles/engine.hpp"
#include "dem/triangles/grain_shape.hpp"
#include "dem/triangles/grain_spectrum.hpp"
#include "dem/triangles/sample.hpp"
#include "geometry/base/index.hpp"
#include "tests/support/moving_triangles.hpp"

namespace isostat {
namespace {

// A rod along x about the origin, at rest: a chain of eight triangles, 0 to 7 or the other way round.
State<TriangleGrains> rod(const TriangleLawScene& law) {
  State<TriangleGrains> s;
  s.scene = default_scene(SceneSystem::triangles);
  s.law = resolve(law);
  const GrainTemplate grain = grain_template(grain_shape("rod", 0.4), {});
  append_grain(s.packing, grain, {}, 0, GrainPart::free, 7);
  s.time_step = 0.2 / grain_frequencies(grain).back();
  return s;
}
TriangleLawScene law_with(BeamFailure failure) {
  TriangleLawScene law;
  law.failure = failure;
  return law;
}

// Halves that fly apart break the beam between them, and no other.
TEST(BeamFailure, BreaksARodIntoTwoGrains) {
  TriangleLawScene law = law_with(BeamFailure::break_);
  law.limit_tension = 500;
  State<TriangleGrains> s = rod(law);
  for (std::size_t k = 0; k < 8; ++k)
    s.packing.bodies.velocity[k] = {{s.packing.bodies.position[k][0] > 0 ? 60.0 : -60.0, 5}};
  const Vec2 momentum = oracle::momentum(s);
  const double turning = oracle::angular_momentum(s);
  Solver<TriangleGrains> solver(s, {});
  while (s.packing.grains.size() == 1 && solver.time() < 1e-2) {
    for (const Link<2>& l : s.packing.links) EXPECT_LE(-l.normal_force, 500 * 1.5);  // none holds on beyond a step
    solver.step();
    solver.snapshot(s);
  }
  ASSERT_EQ(s.packing.events.size(), 1u);
  const BeamEvent& event = s.packing.events.front();
  EXPECT_EQ(event.mode, BeamMode::tension);
  EXPECT_TRUE(event.broken);
  EXPECT_NEAR(event.time, s.time, 1e-12);
  EXPECT_EQ(event.body_i + 1, event.body_j);
  EXPECT_EQ(event.body_i, 3);
  EXPECT_EQ(s.packing.grains.id, (std::vector<std::int64_t>{7, 8}));
  EXPECT_EQ(s.packing.grains.begin, (std::vector<std::int32_t>{0, 4, 8}));
  EXPECT_EQ(s.packing.links.size(), 6u);
  EXPECT_EQ(s.packing.beams.size(), 6u);
  EXPECT_LT(norm(oracle::momentum(s) - momentum), 1e-13 * 8);
  EXPECT_NEAR(oracle::angular_momentum(s), turning, 1e-13 * 8);

  // Sent back, they meet: as two grains they overlap, push, and part again.
  for (Vec2& v : s.packing.bodies.velocity) v = -1.0 * v;
  s.memory = {};
  Solver<TriangleGrains> back(s, {});
  std::size_t met = 0;
  double largest = 0;
  for (int k = 0; k < 4000; ++k) {
    back.step();
    back.snapshot(s);
    met += s.packing.overlaps.size();
    for (const Overlap& o : s.packing.overlaps) largest = std::max(largest, o.normal_force);
  }
  EXPECT_GT(met, 10u);
  EXPECT_GT(largest, 100);
  EXPECT_TRUE(s.packing.overlaps.empty());
  EXPECT_LT(norm(oracle::momentum(s) + momentum), 1e-12 * 8);
}

// Many breaks at once, restarted lists and all: momentum stays, triangles keep their ids, every event names a beam that
// was there and is not, in order of time.
TEST(BeamFailure, KeepsMomentumThroughManyBreaks) {
  oracle::MovingTriangles m;
  m.count = 60, m.shapes = "square,L", m.step_fraction = 0.2, m.law = oracle::soft_beams();
  m.law.failure = BeamFailure::break_, m.law.limit_tension = 500, m.law.limit_shear = 300, m.law.limit_bending = 4;
  State<TriangleGrains> s = moving_triangles(m);
  const State<TriangleGrains> start = s;
  s = [&] {
    Solver<TriangleGrains> solver(s, {});
    solver.run(500);
    State<TriangleGrains> end = s;
    solver.snapshot(end);
    return end;
  }();
  const double size = 100 * oracle::total_mass(s);
  EXPECT_LT(norm(oracle::momentum(s) - oracle::momentum(start)), 1e-12 * size);
  EXPECT_GT(s.packing.events.size(), 20u);
  EXPECT_GT(s.packing.grains.size(), start.packing.grains.size() + 5);
  EXPECT_EQ(s.packing.links.size() + s.packing.events.size(), start.packing.links.size());
  std::vector<std::int64_t> ids = s.packing.bodies.id, first = start.packing.bodies.id;
  std::sort(ids.begin(), ids.end()), std::sort(first.begin(), first.end());
  EXPECT_EQ(ids, first);
  const auto joined = [](const State<TriangleGrains>& state, const BeamEvent& e) {
    return std::any_of(state.packing.links.begin(), state.packing.links.end(), [&](const Link<2>& l) {
      const std::int64_t i = state.packing.bodies.id[idx(l.i)], j = state.packing.bodies.id[idx(l.j)];
      return (i == e.body_i && j == e.body_j) || (i == e.body_j && j == e.body_i);
    });
  };
  int modes[3] = {};
  for (std::size_t k = 0; k < s.packing.events.size(); ++k) {
    const BeamEvent& e = s.packing.events[k];
    EXPECT_TRUE(joined(start, e) && !joined(s, e));
    if (k > 0) {
      EXPECT_GE(e.time, s.packing.events[k - 1].time);
    }
    ++modes[static_cast<int>(e.mode)];
  }
  for (const int count : modes) EXPECT_GT(count, 0) << modes[0] << " " << modes[1] << " " << modes[2];
}

// Pulled beyond its threshold a beam carries the threshold and no more, and stays longer for good.
TEST(BeamFailure, YieldsForGood) {
  TriangleLawScene law = law_with(BeamFailure::yield);
  law.limit_tension = 300;
  State<TriangleGrains> s = rod(law);
  const std::vector<Beam> before = s.packing.beams;
  for (std::size_t k = 0; k < 8; ++k) s.packing.bodies.velocity[k] = {{300 * s.packing.bodies.position[k][0] / 0.2, 0}};
  Solver<TriangleGrains> solver(s, {});
  double most = 0;
  for (int k = 0; k < 20000; ++k) {
    solver.step();
    if (k % 10 != 0) continue;
    solver.snapshot(s);
    for (const Link<2>& l : s.packing.links) most = std::max(most, -l.normal_force);
  }
  EXPECT_LT(most, 300 * (1 + 1e-9));
  EXPECT_GT(most, 299);
  ASSERT_FALSE(s.packing.events.empty());
  EXPECT_LE(s.packing.events.size(), 7u);  // the first time of each beam
  for (const BeamEvent& e : s.packing.events) {
    EXPECT_EQ(e.mode, BeamMode::tension);
    EXPECT_FALSE(e.broken);
  }
  double longer = 0;
  for (std::size_t b = 0; b < 7; ++b) {
    longer += s.packing.beams[b].rest_length / before[b].rest_length - 1;
    EXPECT_GE(s.packing.beams[b].rest_length, before[b].rest_length);
    EXPECT_EQ(s.packing.beams[b].stiffness, before[b].stiffness);
  }
  EXPECT_GT(longer, 0.5);
  // Dampers have stopped all but slow bending: beams are as long as they have become.
  for (const Link<2>& l : s.packing.links) EXPECT_LT(std::abs(l.normal_force), 30);
  EXPECT_EQ(s.packing.grains.size(), 1u);
}

TEST(BeamFailure, YieldsAtEachOfItsLimits) {
  struct Case {
    std::optional<double> TriangleLawScene::*limit;
    double value;
    BeamMode mode;
  };
  for (const Case& c : {Case{&TriangleLawScene::limit_stretch, 0.02, BeamMode::tension},
                        Case{&TriangleLawScene::limit_shear, 200, BeamMode::shear},
                        Case{&TriangleLawScene::limit_bending, 5, BeamMode::bending},
                        Case{&TriangleLawScene::limit_angle, 0.02, BeamMode::bending}}) {
    TriangleLawScene law = law_with(BeamFailure::yield);
    law.*c.limit = c.value;
    State<TriangleGrains> s = rod(law);
    for (std::size_t k = 0; k < 8; ++k) {
      const double x = s.packing.bodies.position[k][0] / 0.2;
      s.packing.bodies.velocity[k] = {{60 * x, 150 * x * x}};
    }
    Solver<TriangleGrains> solver(s, {});
    double most = 0;
    for (int k = 0; k < 400; ++k) {
      solver.step();
      solver.snapshot(s);
      for (const Link<2>& l : s.packing.links) {
        const BeamTurns t = beam_turns(s.packing, l);
        const double lever = l.tangential_force * t.length / 2;
        most = std::max(most, c.limit == &TriangleLawScene::limit_stretch
                                  ? std::abs(t.length / s.packing.beams[idx(l.beam)].rest_length - 1)
                              : c.limit == &TriangleLawScene::limit_shear ? std::abs(l.tangential_force)
                              : c.limit == &TriangleLawScene::limit_bending
                                  ? std::max(std::abs(lever + l.moment), std::abs(lever - l.moment))
                                  : std::max(std::abs(t.turn_i), std::abs(t.turn_j)));
      }
    }
    EXPECT_NEAR(most, c.value, 1e-9 * c.value);
    ASSERT_FALSE(s.packing.events.empty());
    for (const BeamEvent& e : s.packing.events) {
      EXPECT_EQ(e.mode, c.mode);
      EXPECT_FALSE(e.broken);
    }
  }
}

// Below every threshold a law that can fail is the law that cannot, bit for bit.
TEST(BeamFailure, ChangesNothingBelowItsLimits) {
  oracle::MovingTriangles m;
  m.law.friction = 0.3;
  State<TriangleGrains> s = moving_triangles(m), strong = s;
  strong.law.failure = BeamFailure::break_, strong.law.limit_tension = strong.law.limit_bending = 1e9;
  for (State<TriangleGrains>* run : {&s, &strong}) {
    Solver<TriangleGrains> solver(*run, {});
    solver.run(200);
    solver.snapshot(*run);
  }
  EXPECT_EQ(s.packing.bodies.id, strong.packing.bodies.id);
  EXPECT_EQ(s.packing.bodies.position, strong.packing.bodies.position);
  EXPECT_EQ(s.packing.angle, strong.packing.angle);
  EXPECT_FALSE(s.packing.overlaps.empty());
}

}  // namespace
}  // namespace isostat
