// Networks of triangles: reading, overlaps found, round trip, faults.
#include "dem/triangles/network_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <random>

#include "dem/files/packing_file.hpp"
#include "dem/input_error.hpp"
#include "dem/triangles/network_law.hpp"
#include "dem/triangles/overlap_at_rest.hpp"
#include "dem/triangles/touching_triangles.hpp"
#include "geometry/triangle_overlap.hpp"

namespace isostat {
namespace {

// A square of four triangles about (x, y), beams in a ring; ids from `first` on.
std::string square(int first, int grain, double x, double y, double side) {
  const double h = side / 2;
  const double cx[] = {x - h, x + h, x + h, x - h}, cy[] = {y - h, y - h, y + h, y + h};
  std::string text;
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t n = (k + 1) % 4;
    text += "triangle " + std::to_string(first + static_cast<int>(k)) + " " + std::to_string(grain);
    for (const double v : {x, y, cx[k], cy[k], cx[n], cy[n]}) text += " " + std::to_string(v);
    text += "\n";
  }
  for (int k = 0; k < 4; ++k)
    text += "beam " + std::to_string(first + k) + " " + std::to_string(first + (k + 1) % 4) + "\n";
  return text;
}

std::vector<std::string> faults_of(const std::string& text) {
  try {
    parse_triangle_network(text, "t.net");
  } catch (const InputError& e) {
    std::vector<std::string> lines;
    for (const Fault& f : e.faults()) lines.push_back(std::to_string(f.line) + " " + f.key + " " + f.rule);
    return lines;
  }
  return {};
}

TEST(TriangleNetwork, TwoSquaresMakeOneOverlap) {
  const auto file = parse_triangle_network(square(0, 7, 0, 0, 1) + square(10, 3, 0.875, 0.25, 1), "t.net");
  const TrianglePacking& p = file.packing;
  EXPECT_EQ(p.grains.id, (std::vector<std::int64_t>{7, 3}));
  EXPECT_EQ(p.grains.begin, (std::vector<std::int32_t>{0, 4, 8}));
  EXPECT_EQ(p.links.size(), 8u);
  ASSERT_EQ(p.overlaps.size(), 1u);
  EXPECT_NEAR(p.overlaps[0].area, 0.125 * 0.75, 1e-15);
  EXPECT_NEAR(p.overlaps[0].normal[0], 1, 0.1);  // pushes grain j to the right
  // p = Y A / L_c with L_c = 1; the force is the pressure times the chord, from (.5, -.25) to (.375, .5).
  EXPECT_NEAR(p.overlaps[0].normal_force, 2e7 * 0.125 * 0.75 * std::hypot(0.125, 0.75), 1e-6);
  EXPECT_DOUBLE_EQ(p.bodies.mass[0], 0.25);
  EXPECT_DOUBLE_EQ(p.bodies.inertia[0], 0.25 * (0.5 + 0.5 + 1) / 36);
  EXPECT_NEAR(p.beams[0].rest_length, std::sqrt(2.0) / 3, 1e-15);
  for (std::size_t k = 0; k < p.bodies.size(); ++k)
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(norm(corners_of(p, k)[c] - file.triangles[k].corner[c]), 0, 1e-15);
}

TEST(TriangleNetwork, TrianglesOfAGrainBecomeContiguous) {
  const auto file = parse_triangle_network(
      "triangle 5 1 0 0 1 0 0 1\ntriangle 6 2 5 0 5 1 6 0\ntriangle 4 1 1 0 1 1 0 1\nbeam 4 5\n", "t.net");
  EXPECT_EQ(file.packing.bodies.id, (std::vector<std::int64_t>{5, 4, 6}));
  EXPECT_EQ(file.packing.grains.begin, (std::vector<std::int32_t>{0, 2, 3}));
  EXPECT_EQ(file.packing.links[0].i, 0);  // the earlier one first, as a run keeps them
  EXPECT_NEAR(file.packing.beams[0].rest_angle_i, -std::numbers::pi / 4, 1e-15);
  EXPECT_EQ(file.triangles[2].corner[1], (Vec2{{6, 0}}));  // made anticlockwise
}

TEST(TriangleNetwork, APeriodicGrainMeetsItsImageAndIsBroughtTogether) {
  // A triangle wider than the cell, and a grain whose halves stand in different images.
  const auto own = parse_triangle_network("cell 1 2\ntriangle 1 1 0 0 1.5 0 .75 .5\n", "t.net");
  ASSERT_EQ(own.packing.overlaps.size(), 1u);
  EXPECT_EQ(own.packing.overlaps[0].shift, (ImageShift<2>{1, 0}));
  EXPECT_NEAR(own.packing.overlaps[0].area, 0.5 * 0.5 * 0.5 / 3, 1e-15);

  const auto split = parse_triangle_network(
      "cell 4 4\ntriangle 1 1 0 0 1 0 0 1\ntriangle 2 1 5 0 5 1 4 1\nbeam 1 2\ntriangle 3 2 .5 .5 1.5 .5 1 1.5\n",
      "t.net");
  EXPECT_EQ(split.packing.links[0].shift, (ImageShift<2>{0, 0}));
  EXPECT_NEAR(split.packing.beams[0].rest_length, std::sqrt(2.0) / 3, 1e-15);
  EXPECT_EQ(split.triangles[1].corner[0], (Vec2{{1, 0}}));
  EXPECT_EQ(split.packing.overlaps.size(), 1u);  // of both halves, which are neighbours
}

TEST(TriangleNetwork, ConcaveGrainsCanHaveTwoOverlaps) {
  // A bow of four triangles in a chain; a bar crosses the first and the last, which are no neighbours.
  const std::string bracket =
      "triangle 1 1 0 0 1 0 0 1\ntriangle 2 1 0 0 1 0 2 -1\ntriangle 3 1 1 0 2 -1 4 0\ntriangle 4 1 1 0 4 0 5 1\n";
  const std::string bar = "triangle 9 2 -2 .25 7 .25 -2 .5\n";
  EXPECT_EQ(parse_triangle_network(bracket + bar, "t.net").packing.overlaps.size(), 2u);
  // Two pieces through triangles that share an edge are one overlap, though the polygons be apart.
  EXPECT_EQ(parse_triangle_network("triangle 1 1 0 0 2 0 2 2\ntriangle 2 1 -.1 .1 1.9 2.1 -.1 2.1\n"
                                   "triangle 9 2 -1 .5 3 .5 -1 1\n",
                                   "t.net")
                .packing.overlaps.size(),
            1u);
}

TEST(TriangleNetwork, TouchingPairsAreThoseOfAllPairs) {
  std::mt19937 random(5);
  const auto uniform = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
  for (const bool periodic : {false, true})
    for (int round = 0; round < 20; ++round) {
      std::string text = periodic ? "cell 1 .8\n" : "";
      for (int k = 0; k < 40; ++k) {
        const double x = uniform(-1, 2), y = uniform(-1, 2), s = k == 0 ? 1.5 : 0.15;
        text += "triangle " + std::to_string(k) + " " + std::to_string(k / 2);
        for (int c = 0; c < 3; ++c)
          text += " " + std::to_string(x + uniform(0, s)) + " " + std::to_string(y + uniform(0, s));
        text += "\n";
      }
      TriangleNetworkFile file;
      try {
        file = parse_triangle_network(text, "t.net");
      } catch (const InputError&) {
        continue;  // two of one grain that overlap
      }
      const TrianglePacking& p = file.packing;
      const auto grain = grain_of(p.grains);
      std::size_t pairs = 0;
      double area = 0;
      const int reach = periodic ? 6 : 0;
      for (std::int32_t i = 0; i < 40; ++i)
        for (std::int32_t j = 0; j < 40; ++j)
          for (int sx = -reach; sx <= reach; ++sx)
            for (int sy = -reach; sy <= reach; ++sy) {
              const ImageShift<2> s{sx, sy}, back{-sx, -sy};
              const auto gi = grain[static_cast<std::size_t>(i)], gj = grain[static_cast<std::size_t>(j)];
              if (gi > gj || (gi == gj && s <= back)) continue;
              const TriangleOverlap o =
                  triangle_overlap(file.triangles[static_cast<std::size_t>(i)],
                                   image_of(file.triangles[static_cast<std::size_t>(j)], p.cell, s));
              pairs += o.area > 0, area += o.area;
            }
      EXPECT_EQ(touching_triangles(p, file.triangles).size(), pairs);
      double found = 0;
      for (const Overlap& o : p.overlaps) found += o.area;
      EXPECT_NEAR(found, area, 1e-12);
    }
}

TEST(TriangleNetwork, RoundTrip) {
  const std::string text = "cell 3 3.5\n" + square(0, 7, 0.1, 0.2, 1) + square(10, 3, 0.9, 0.3, 1);
  const auto file = parse_triangle_network(text, "t.net");
  const std::string written = triangle_network_text(file.packing, file.triangles);
  const auto again = parse_triangle_network(written, "u.net");
  EXPECT_EQ(triangle_network_text(again.packing, again.triangles), written);
  EXPECT_EQ(again.packing.bodies.position, file.packing.bodies.position);
  EXPECT_EQ(again.packing.beams, file.packing.beams);
  EXPECT_EQ(again.packing.overlaps.size(), file.packing.overlaps.size());
}

TEST(TriangleNetwork, Faults) {
  using testing::ElementsAre;
  using testing::HasSubstr;
  const std::string two = "triangle 1 1 0 0 1 0 0 1\ntriangle 2 1 1 0 1 1 0 1\n";
  EXPECT_THAT(faults_of("# none\n"), ElementsAre(HasSubstr("no triangle line")));
  EXPECT_THAT(faults_of(two + "triangle 3 2 0 0 1 1 2 2\n"), ElementsAre(HasSubstr("3 triangle has no area")));
  EXPECT_THAT(faults_of(two + "triangle 1 2 5 0 6 0 5 1\n"),
              ElementsAre(HasSubstr("3 triangle.ID used before in line 1")));
  EXPECT_THAT(faults_of(two + "beam 1 1\n"), ElementsAre(HasSubstr("3 beam a beam cannot join a triangle to itself")));
  EXPECT_THAT(faults_of(two + "beam 1 9\n"), ElementsAre(HasSubstr("3 beam.J no triangle line has this ID")));
  EXPECT_THAT(faults_of(two + "beam 1 2\nbeam 2 1\n"), ElementsAre(HasSubstr("4 beam repeats line 3")));
  EXPECT_THAT(faults_of(two + "triangle 3 1 5 5 6 5 5 6\nbeam 2 3\n"), ElementsAre(HasSubstr("share no edge")));
  EXPECT_THAT(faults_of(two + "triangle 3 1 .1 .1 1.1 .1 .1 1.1\n"),
              ElementsAre(HasSubstr("overlaps the triangle of line 1"), HasSubstr("overlaps the triangle of line 2")));
  EXPECT_THAT(faults_of(two + "grain 9 0 0 1\n"), ElementsAre(HasSubstr("not of both")));
  EXPECT_THAT(faults_of(two + "triangle 3 2 0 0 1 0 0\n"), ElementsAre(HasSubstr("triangle ID GRAIN")));
  EXPECT_THAT(faults_of(two + "triangle 3 2 0 0 nan 0 0 1\n"), ElementsAre(HasSubstr("triangle.X1 must be a finite")));
  EXPECT_THAT(faults_of("cell 1 0\n" + two), ElementsAre(HasSubstr("1 cell.L2")));
  EXPECT_THAT(faults_of("cell .01 1\n" + two), ElementsAre(HasSubstr("below 0.1 of the largest")));
  EXPECT_THAT(faults_of(two + "beam 1 2 1 0\n"), ElementsAre(HasSubstr("needs a cell line")));
}

}  // namespace
}  // namespace isostat
