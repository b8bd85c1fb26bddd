// Where grains of triangles begin: without overlap, inside their container, at the fraction asked for.
#include "dem/triangles/sample.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dem/input_error.hpp"
#include "dem/scene/file.hpp"
#include "dem/state/container_region.hpp"
#include "dem/triangles/at_rest.hpp"
#include "dem/triangles/grain_shape.hpp"
#include "dem/triangles/grain_spectrum.hpp"
#include "dem/triangles/placement.hpp"

namespace isostat {
namespace {

using ::testing::HasSubstr;

Scene scene_of(const std::string& keys) {
  return parse_scene("system = \"triangles\"\n" + keys, "scene.toml", {}, SceneChecks::keys);
}

template <class Action>
std::string refusal(const Action& action) {
  try {
    action();
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

double free_area(const TrianglePacking& p) {
  double area = 0;
  for (std::size_t g = 0; g < p.grains.size(); ++g)
    if (p.grains.part[g] == GrainPart::free) area += grain_area(p, g);
  return area;
}

// Pairs of triangles of two grains that are not apart; walls do not count among themselves.
int overlaps(const TrianglePacking& p) {
  const std::vector<std::int32_t> of = grain_of(p.grains);
  std::vector<TriangleCorners> corners;
  for (std::size_t k = 0; k < p.bodies.size(); ++k) corners.push_back(corners_of(p, k));
  const auto is_free = [&](std::size_t k) { return p.grains.part[static_cast<std::size_t>(of[k])] == GrainPart::free; };
  int found = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (!is_free(i)) continue;
    for (std::size_t j = 0; j < corners.size(); ++j) {
      if (of[i] == of[j] || (j < i && is_free(j))) continue;
      TriangleCorners other = corners[j];
      if (p.cell) {
        const Vec2 shift = p.cell->offset(p.cell->nearest_image(p.bodies.position[j] - p.bodies.position[i]));
        for (Vec2& q : other) q += shift;
      }
      found += !apart(corners[i], other, 0);
    }
  }
  return found;
}

long count(const TrianglePacking& p, GrainPart part) {
  return std::count(p.grains.part.begin(), p.grains.part.end(), part);
}

TEST(TrianglePlacement, ApartIsExactForTriangles) {
  const TriangleCorners a{{{{0, 0}}, {{1, 0}}, {{0, 1}}}};
  const auto moved = [&](double x, double y) {
    TriangleCorners t = a;
    for (Vec2& q : t) q += Vec2{{x, y}};
    return t;
  };
  EXPECT_FALSE(apart(a, a, 0));
  EXPECT_FALSE(apart(a, moved(0.49, 0.49), 0));
  EXPECT_TRUE(apart(a, moved(0.51, 0.51), 0));
  EXPECT_TRUE(apart(a, moved(0.5, 0.5), 0));  // a corner on an edge
  EXPECT_TRUE(apart(a, moved(1.1, 0), 0.1 - 1e-12));
  EXPECT_FALSE(apart(a, moved(1.1, 0), 0.1 + 1e-12));
  EXPECT_TRUE(apart(a, moved(0.95, 0), -0.05 - 1e-12));  // a little overlap is allowed
  EXPECT_FALSE(apart(a, moved(0.9, 0), -0.05));
}

TEST(AppendGrain, IsTheTemplateWithoutLoad) {
  TrianglePacking p;
  const GrainTemplate star = grain_template(grain_shape("star", 0.3), {});
  append_grain(p, grain_template(grain_shape("square", 0.1), {}), {{3, 4}}, 0.3, GrainPart::wall, 7);
  append_grain(p, star, {{-1, 2}}, 0.7, GrainPart::free, 9);
  EXPECT_EQ(p.grains.id, (std::vector<std::int64_t>{7, 9}));
  EXPECT_EQ(p.grains.begin, (std::vector<std::int32_t>{0, 4, 14}));
  EXPECT_EQ(p.links.size(), 4 + star.beams.size());
  EXPECT_EQ(p.bodies.id.back(), 13);
  for (const Link<2>& l : p.links) {
    ASSERT_EQ(l.kind, LinkKind::beam);
    const BeamTurns t = beam_turns(p, l);
    EXPECT_NEAR(t.length, p.beams[static_cast<std::size_t>(l.beam)].rest_length, 1e-14);
    EXPECT_NEAR(t.turn_i, 0, 1e-13);
    EXPECT_NEAR(t.turn_j, 0, 1e-13);
  }
  double mass = 0;
  Vec2 moment{};
  for (std::size_t k = 4; k < 14; ++k)
    mass += p.bodies.mass[k], moment += p.bodies.mass[k] * (p.bodies.position[k] - Vec2{{-1, 2}});
  EXPECT_NEAR(mass, star.mass, 1e-14);
  EXPECT_NEAR(norm(moment), 0, 1e-14);
  EXPECT_NEAR(p.grains.radius[1], 1.15 * 0.15, 1e-12);  // a star has its tips on the circle of its diameter
}

TEST(InitialTriangles, FillAPeriodicCellWithoutOverlap) {
  const Scene scene = scene_of("[grains]\ncount = 200\nsolid_fraction = 0.5\n[cell]\naspect = 2.0\n");
  const State<TriangleGrains> s = place_triangles(scene, 5);
  EXPECT_EQ(count(s.packing, GrainPart::free), 200);
  EXPECT_EQ(s.packing.grains.size(), 200u);
  EXPECT_EQ(s.packing.bodies.size(), 800u);
  ASSERT_TRUE(s.packing.cell);
  EXPECT_NEAR(s.packing.cell->length[0] / s.packing.cell->length[1], 2, 1e-12);
  EXPECT_NEAR(free_area(s.packing) / s.packing.cell->measure(), 0.5, 1e-12);
  EXPECT_EQ(overlaps(s.packing), 0);
  EXPECT_GT(s.random_counter, 800u);
  const auto [least, most] = std::minmax_element(s.packing.bodies.mass.begin(), s.packing.bodies.mass.end());
  EXPECT_GE(*least, 0.1 * 0.1 / 4 * (1 - 1e-12));
  EXPECT_LE(*most, 0.2 * 0.2 / 4 * (1 + 1e-12));

  const State<TriangleGrains> again = place_triangles(scene, 5), other = place_triangles(scene, 6);
  EXPECT_EQ(again.packing.bodies.position, s.packing.bodies.position);
  EXPECT_EQ(again.packing.angle, s.packing.angle);
  EXPECT_NE(other.packing.bodies.position, s.packing.bodies.position);
}

TEST(InitialTriangles, ShapesAreTakenInTurn) {
  const State<TriangleGrains> s = place_triangles(
      scene_of("[grains]\ncount = 60\nshape = \"square, star, L, triangle\"\nsolid_fraction = 0.3\n"), 1);
  ASSERT_EQ(s.packing.grains.size(), 60u);
  for (std::size_t g = 0; g < 60; ++g)
    EXPECT_EQ(s.packing.grains.begin[g + 1] - s.packing.grains.begin[g], (std::vector<int>{4, 10, 12, 1}[g % 4]));
  EXPECT_EQ(overlaps(s.packing), 0);
}

TEST(InitialTriangles, StepIsThatOfTheSmallestGrain) {
  const Scene scene = scene_of("[grains]\ncount = 50\n");
  const State<TriangleGrains> s = place_triangles(scene, 1);
  const double side = 2 * std::sqrt(*std::min_element(s.packing.bodies.mass.begin(), s.packing.bodies.mass.end()));
  const double omega = grain_frequencies(grain_template(grain_shape("square", side), material_of(scene))).back();
  EXPECT_NEAR(s.time_step, 0.6 / omega, 1e-9 * s.time_step);
}

class InContainer : public ::testing::TestWithParam<const char*> {};

TEST_P(InContainer, GrainsLieInsideAndTouchNothing) {
  for (const char* walls : {"grains", "smooth"}) {
    const Scene scene =
        scene_of("[grains]\ncount = 150\nsolid_fraction = 0.4\n[container]\nwidth = 3.0\nradius = 2.0\n" +
                 std::string("shape = \"") + GetParam() + "\"\nwalls = \"" + walls + "\"\n");
    const State<TriangleGrains> s = place_triangles(scene, 3);
    const TrianglePacking& p = s.packing;
    EXPECT_FALSE(p.cell);
    EXPECT_EQ(count(p, GrainPart::free), 150);
    EXPECT_GT(count(p, GrainPart::wall), 1);
    EXPECT_EQ(count(p, GrainPart::lid) > 0, GetParam() == std::string("hopper"));
    EXPECT_EQ(overlaps(p), 0);
    double top = -10;
    const std::vector<std::int32_t> of = grain_of(p.grains);
    for (std::size_t k = 0; k < p.bodies.size(); ++k)
      for (const Vec2& q : corners_of(p, k)) {
        if (p.grains.part[static_cast<std::size_t>(of[k])] == GrainPart::free) {
          EXPECT_TRUE(holds(scene.container, q, 0)) << k;
          top = std::max(top, q[1]);
        } else {
          EXPECT_FALSE(holds(scene.container, q, 1e-9)) << k;  // no wall stands into the room
        }
      }
    const double height = height_of_area(scene.container, free_area(p) / 0.4);
    EXPECT_LE(top, height);
    EXPECT_GT(top, height - 0.3);
    if (walls == std::string("smooth")) {
      const std::vector<double> inverse = inverse_lengths(p, s.law);
      for (std::size_t g = 0; g < p.grains.size(); ++g) EXPECT_EQ(inverse[g] == 0, p.grains.part[g] != GrainPart::free);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Each, InContainer, ::testing::Values("box", "hopper", "drum"));

// A grain that falls anywhere over the floor meets a wall: rays from inside leave no room between wall grains.
TEST(Container, WallsOfGrainsHaveNoGap) {
  for (const char* shape : {"box", "hopper", "drum"}) {
    const Scene scene = scene_of("[grains]\ncount = 20\n[container]\nwidth = 3.0\nheight = 1.0\nshape = \"" +
                                 std::string(shape) + "\"\n");
    const TrianglePacking p = place_triangles(scene, 1).packing;
    const Vec2 eye{{0, shape == std::string("drum") ? 0.0 : 0.5}};
    const std::vector<std::int32_t> of = grain_of(p.grains);
    for (int n = 0; n < 1000; ++n) {
      const double angle = (shape == std::string("drum") ? 2 : -1) * std::numbers::pi * (n + 0.5) / 1000;
      const Vec2 far = eye + Vec2{{5 * std::cos(angle), 5 * std::sin(angle)}}, side{{1e-6 * std::sin(angle), 0}};
      const TriangleCorners ray{{eye, far, far + side}}, turned{{eye, far + side, far}};
      bool met = false;
      for (std::size_t k = 0; k < p.bodies.size() && !met; ++k)
        if (p.grains.part[static_cast<std::size_t>(of[k])] != GrainPart::free)
          met = !apart(corners_of(p, k), doubled_area(ray[0], ray[1], ray[2]) > 0 ? ray : turned, 0);
      EXPECT_TRUE(met) << shape << " " << angle;
    }
  }
}

// Teeth: along a row of a box the inner faces lie alternately on the wall and half a side behind it.
TEST(Container, EveryOtherSquareOfARowIsSetBack) {
  ContainerScene box;
  box.shape = ContainerShape::box;
  box.width = 2, box.wall_size = 0.1;
  const GrainTemplate grain = grain_template(grain_shape("square", 0.1), {});
  std::vector<double> heights;
  for (const WallGrain& w : wall_grains(box, grain, {}))
    if (std::abs(w.centre[0]) < 1 && w.centre[1] < 0) heights.push_back(w.centre[1]);
  ASSERT_EQ(heights.size(), 20u);
  for (std::size_t k = 0; k < heights.size(); ++k) {
    EXPECT_NEAR(std::min(heights[k], heights[k ^ 1]), -0.1, 1e-12);
    EXPECT_NEAR(heights[k] + heights[k ^ 1], -0.15, 1e-12);
  }
}

TEST(InitialTriangles, TwoSquaresCollide) {
  const Scene scene = scene_of("[grains]\narrangement = \"collision\"\nsize_max = 0.14\nspeed = 30\noffset = 0.5\n");
  const State<TriangleGrains> s = place_triangles(scene, 1);
  const TrianglePacking& p = s.packing;
  EXPECT_FALSE(p.cell);
  ASSERT_EQ(p.grains.size(), 2u);
  ASSERT_EQ(p.bodies.size(), 8u);
  Vec2 centre[2];
  for (std::size_t k = 0; k < 8; ++k) {
    centre[k / 4] += 0.25 * p.bodies.position[k];
    EXPECT_EQ(p.bodies.velocity[k], (k < 4 ? Vec2{{30, 0}} : Vec2{}));
    EXPECT_EQ(p.angle[k], 0);
  }
  EXPECT_NEAR(centre[0][1] - centre[1][1], 0.07, 1e-15);
  EXPECT_GT(centre[1][0] - centre[0][0], 0.14);
  EXPECT_LT(centre[1][0] - centre[0][0], 0.16);
  EXPECT_EQ(overlaps(p), 0);
}

TEST(InitialTriangles, WhatHasNoRoomIsRefused) {
  const auto place = [](const std::string& keys) { return refusal([&] { place_triangles(scene_of(keys), 1); }); };
  EXPECT_THAT(place("[grains]\ncount = 1\n"), HasSubstr("too few for a periodic cell"));
  EXPECT_THAT(place("[grains]\ncount = 500\n[container]\nshape = \"drum\"\n"), HasSubstr("container is too small"));
  EXPECT_THAT(place("[grains]\ncount = 2\n[container]\nshape = \"box\"\nwidth = 0.12\n"),
              HasSubstr("random placement without overlap found no room"));
}

class StartOfTriangles : public ::testing::Test {
 protected:
  static inline const std::string kBox = "[grains]\ncount = 30\n[container]\nshape = \"box\"\nwidth = 2.0\n";
  StartOfTriangles() : file_(place_triangles(scene_of(kBox), 1)) {
    file_.packing.bodies.velocity[3] = {{1, 2}};
    file_.time = 5;
  }
  State<TriangleGrains> start(const std::string& keys) const { return start_from(file_, "f.h5", scene_of(keys), 1); }
  State<TriangleGrains> file_;
};

TEST_F(StartOfTriangles, TheSameContainerStaysWhereItIs) {
  file_.scene.stages = default_scene(SceneSystem::triangles, 1).stages;
  file_.scene.stages[0].container = {.vibration_amplitude = 0.1, .vibration_frequency = 10};
  file_.progress.started = true;
  file_.progress.start_time = 4.95;  // half a period
  file_.surroundings.grains_left = 3;
  const State<TriangleGrains> s = start(kBox + "[law]\nstiffness = 2e5\n");
  EXPECT_EQ(s.time, 0);
  EXPECT_EQ(s.packing.grains.id, file_.packing.grains.id);
  EXPECT_EQ(s.packing.bodies.velocity, file_.packing.bodies.velocity);
  EXPECT_EQ(s.packing.beams[0].stiffness, 2e5);
  EXPECT_EQ(s.packing.beams[0].rest_length, file_.packing.beams[0].rest_length);
  EXPECT_NEAR(s.surroundings.start_offset[1], -0.2, 1e-12);
  EXPECT_EQ(s.surroundings.grains_left, 0);
}

TEST_F(StartOfTriangles, AnotherContainerIsBuiltAnew) {
  const State<TriangleGrains> s = start("[container]\nshape = \"box\"\nwidth = 2.5\n");
  EXPECT_EQ(count(s.packing, GrainPart::free), 30);
  EXPECT_GT(count(s.packing, GrainPart::wall), count(file_.packing, GrainPart::wall));
  EXPECT_EQ(s.packing.bodies.velocity[3], (Vec2{{1, 2}}));
  EXPECT_EQ(s.packing.links.size(), s.packing.beams.size());
  EXPECT_EQ(overlaps(s.packing), 0);
  std::vector<std::int64_t> ids = s.packing.bodies.id;
  std::sort(ids.begin(), ids.end());
  EXPECT_EQ(std::adjacent_find(ids.begin(), ids.end()), ids.end());
}

TEST_F(StartOfTriangles, WhatDoesNotFitIsRefused) {
  EXPECT_THAT(refusal([&] { start("[container]\nshape = \"box\"\nwidth = 1.5\n"); }), HasSubstr("closes on grains"));
  EXPECT_THAT(refusal([&] { start("[[stage]]\npressure = 10\n"); }), HasSubstr("needs a periodic cell"));
  EXPECT_THAT(refusal([&] { start(kBox + "[step]\nfraction = 3\n"); }), HasSubstr("unstable"));
  file_.packing.cell = PeriodicCell<2>{{{5, 5}}};
  EXPECT_THAT(refusal([&] { start("[container]\nshape = \"box\"\nwidth = 2.5\n"); }), HasSubstr("periodic cell"));
  std::fill(file_.packing.grains.part.begin(), file_.packing.grains.part.end(), GrainPart::wall);
  EXPECT_THAT(refusal([&] { start(kBox); }), HasSubstr("holds no grain"));
}

}  // namespace
}  // namespace isostat
