// Triangulations of simple polygons: the triangles fill the polygon and do not overlap; what is no polygon is refused.
#include "geometry/polygon_triangulation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "geometry/base/index.hpp"

namespace isostat {
namespace {

using Kind = PolygonFault::Kind;
using Corners = std::vector<Vec2>;

double area(const Corners& p) {  // anticlockwise positive
  double doubled = 0;
  for (std::size_t k = 2; k < p.size(); ++k) doubled += doubled_area(p[0], p[k - 1], p[k]);
  return doubled / 2;
}

// By crossings of the ray to the right.
bool inside(const Corners& p, const Vec2& x) {
  bool in = false;
  for (std::size_t i = 0, j = p.size() - 1; i < p.size(); j = i++)
    if ((p[i][1] > x[1]) != (p[j][1] > x[1]) &&
        x[0] < p[i][0] + (p[j][0] - p[i][0]) * (x[1] - p[i][1]) / (p[j][1] - p[i][1]))
      in = !in;
  return in;
}

// Radii at ascending angles: simple, and concave more often than not.
Corners random_polygon(std::mt19937_64& random, std::size_t corners) {
  std::uniform_real_distribution<> radius(0.2, 1.0), shake(-0.3, 0.3);
  Corners p;
  for (std::size_t k = 0; k < corners; ++k) {
    const double r = radius(random);
    const double angle = 2 * std::numbers::pi * (static_cast<double>(k) + shake(random)) / static_cast<double>(corners);
    p.push_back({{3 + r * std::cos(angle), -2 + r * std::sin(angle)}});
  }
  return p;
}

void expect_fills(const Corners& p, const TriangleMesh& mesh, std::mt19937_64& random) {
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    const double doubled = doubled_area(mesh.points[idx(t[0])], mesh.points[idx(t[1])], mesh.points[idx(t[2])]);
    EXPECT_GT(doubled, 0);
    sum += doubled / 2;
  }
  EXPECT_NEAR(sum, std::abs(area(p)), 1e-13 * static_cast<double>(mesh.triangles.size()));
  std::uniform_real_distribution<> x(1.9, 4.1), y(-3.1, -0.9);
  for (int k = 0; k < 200; ++k) {
    const Vec2 at{{x(random), y(random)}};
    const auto holds = [&](const std::array<std::int32_t, 3>& t) {
      for (std::size_t e = 0; e < 3; ++e)
        if (doubled_area(mesh.points[idx(t[e])], mesh.points[idx(t[(e + 1) % 3])], at) < 0) return false;
      return true;
    };
    EXPECT_EQ(std::count_if(mesh.triangles.begin(), mesh.triangles.end(), holds), inside(p, at) ? 1 : 0);
  }
}

TEST(PolygonTriangulation, FillsConcavePolygonsInEitherOrientation) {
  std::mt19937_64 random(7);
  for (std::size_t corners = 3; corners < 40; ++corners) {
    Corners p = random_polygon(random, corners);
    if (corners % 2) std::reverse(p.begin(), p.end());
    ASSERT_FALSE(polygon_fault(p)) << corners;
    const TriangleMesh mesh = triangulate_polygon(p);
    EXPECT_EQ(mesh.points, p);  // the corners and no others
    EXPECT_EQ(mesh.triangles.size(), corners - 2);
    EXPECT_EQ(edge_neighbours(mesh).size(), corners - 3);  // a tree
    expect_fills(p, mesh, random);
  }
}

TEST(PolygonTriangulation, KeepsEverySideOnce) {
  std::mt19937_64 random(8);
  const Corners p = random_polygon(random, 25);
  std::map<std::array<std::int32_t, 2>, int> uses;
  for (const auto& t : triangulate_polygon(p).triangles)
    for (std::size_t e = 0; e < 3; ++e) ++uses[{std::min(t[e], t[(e + 1) % 3]), std::max(t[e], t[(e + 1) % 3])}];
  for (std::int32_t k = 0; k < 25; ++k) {
    const std::int32_t next = (k + 1) % 25;
    EXPECT_EQ((uses[{std::min(k, next), std::max(k, next)}]), 1);
  }
}

TEST(PolygonTriangulation, RefinesToASize) {
  std::mt19937_64 random(9);
  for (const std::size_t corners : {4u, 9u, 20u}) {
    const Corners p = random_polygon(random, corners);
    const TriangleMesh mesh = triangulate_polygon(p, 0.2);
    EXPECT_GT(mesh.triangles.size(), 20u);
    expect_fills(p, mesh, random);
    for (const auto& t : mesh.triangles)
      for (std::size_t e = 0; e < 3; ++e)
        EXPECT_LE(norm(mesh.points[idx(t[e])] - mesh.points[idx(t[(e + 1) % 3])]), 0.2 * (1 + 1e-12));
  }
}

// A corner in the middle of a side, and sides that nearly touch.
TEST(PolygonTriangulation, BorderlineButSimple) {
  const Corners flat{{{0, 0}}, {{1, 0}}, {{2, 0}}, {{2, 1}}, {{0, 1}}};
  EXPECT_FALSE(polygon_fault(flat));
  EXPECT_EQ(triangulate_polygon(flat).triangles.size(), 3u);
  const double hair = std::nextafter(0.5, 1.0);
  const Corners close{{{0, 0}}, {{1, 0}}, {{1, 1}}, {{0.5, hair - 0.5}}, {{0, 1}}};
  EXPECT_FALSE(polygon_fault(close));
}

TEST(PolygonTriangulation, NamesTheFault) {
  const auto expect = [](const Corners& p, Kind kind, std::size_t first, std::size_t second) {
    const auto fault = polygon_fault(p);
    ASSERT_TRUE(fault);
    EXPECT_EQ(fault->kind, kind) << describe(*fault);
    EXPECT_EQ(fault->first, first) << describe(*fault);
    EXPECT_EQ(fault->second, second) << describe(*fault);
    EXPECT_THROW(triangulate_polygon(p), PolygonError);
  };
  expect({{{0, 0}}, {{1, 0}}}, Kind::too_few_corners, 0, 0);
  expect({{{0, 0}}, {{1, 0}}, {{NAN, 1}}}, Kind::not_finite, 2, 0);
  expect({{{0, 0}}, {{1, 0}}, {{1, 1}}, {{0, 0}}}, Kind::repeated_corner, 0, 3);
  expect({{{0, 0}}, {{1, 1}}, {{3, 3}}, {{2, 2}}}, Kind::no_area, 0, 0);
  expect({{{0, 0}}, {{1, 1}}, {{1, 0}}, {{0, 1}}}, Kind::self_intersecting, 0, 2);            // a bow tie
  expect({{{0, 0}}, {{2, 0}}, {{2, 2}}, {{1, 0}}, {{0, 2}}}, Kind::self_intersecting, 0, 2);  // a corner on a side
  expect({{{0, 0}}, {{2, 0}}, {{2, 2}}, {{2, 1}}, {{0, 2}}}, Kind::self_intersecting, 1, 2);  // folds back
  expect({{{1, 0}}, {{2, 0}}, {{2, 2}}, {{0, 2}}, {{3, 0}}}, Kind::self_intersecting, 0, 4);  // at the last corner
  EXPECT_THAT(describe({Kind::repeated_corner, 0, 3}), ::testing::HasSubstr("corners 1 and 4"));
  EXPECT_THAT(describe({Kind::self_intersecting, 0, 2}), ::testing::HasSubstr("intersects itself"));
}

}  // namespace
}  // namespace isostat
