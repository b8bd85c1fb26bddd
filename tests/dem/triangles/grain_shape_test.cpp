// Shapes of grains: areas, masses and inertias against closed forms; files; what is refused.
#include "dem/triangles/grain_shape.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "dem/input_error.hpp"
#include "dem/triangles/grain_spectrum.hpp"
#include "geometry/polygon_triangulation.hpp"
#include "tests/dem/triangles/moving_grain.hpp"
#include "tests/support/temporary_folder.hpp"

namespace isostat {
namespace {

using ::testing::HasSubstr;

constexpr double kSize = 0.14, kDensity = 2.5;

GrainTemplate grain_of(const std::string& shape, std::optional<double> size = kSize, double refine = 0) {
  GrainMaterial material;
  material.density = kDensity;
  return grain_template(grain_shape(shape, size, refine), material);
}

struct Expected {
  const char* shape;
  std::size_t triangles, beams;
  double area, gyration;  // [cm^2], [cm^2] J/m
};

// m = rho A. J/m of a regular polygon of side s, (s^2/24) (1 + 3 cot^2(pi/N)); of a rectangle, (a^2 + b^2)/12.
std::vector<Expected> closed_forms() {
  const double s = kSize, pi = std::numbers::pi;
  std::vector<Expected> all;
  const auto regular = [&](const char* name, double sides, std::size_t triangles, std::size_t beams) {
    const double cot = 1 / std::tan(pi / sides);
    all.push_back({name, triangles, beams, sides * s * s * cot / 4, s * s / 24 * (1 + 3 * cot * cot)});
  };
  regular("triangle", 3, 1, 0);
  regular("polygon3", 3, 3, 3);
  regular("square", 4, 4, 4);
  regular("polygon4", 4, 4, 4);
  regular("polygon5", 5, 5, 5);
  regular("polygon12", 12, 12, 12);
  regular("polygon64", 64, 64, 64);
  all.push_back({"rod", 8, 7, s * s / 4, s * s * (1 + 1.0 / 16) / 12});
  // Three squares of side b = S/2 at distances sqrt(2)/3, sqrt(5)/3, sqrt(5)/3 of b from the common centroid.
  const double b = s / 2;
  all.push_back({"L", 12, 14, 3 * b * b, b * b * (1.0 / 6 + (2.0 + 5 + 5) / 27)});
  // Ten triangles (0, outer, inner) of angle 36 degrees: each has int r^2 dA / A = (R^2 + r^2 + R r cos 36)/6.
  const double outer = s / 2, inner = outer * std::sin(pi / 10) / std::sin(3 * pi / 10);
  all.push_back({"star", 10, 10, 5 * outer * inner * std::sin(pi / 5),
                 (outer * outer + inner * inner + outer * inner * std::cos(pi / 5)) / 6});
  return all;
}

TEST(GrainShape, MassAndInertiaAgainstClosedForms) {
  for (const Expected& e : closed_forms()) {
    const GrainTemplate g = grain_of(e.shape);
    EXPECT_EQ(g.triangles.size(), e.triangles) << e.shape;
    EXPECT_EQ(g.beams.size(), e.beams) << e.shape;
    EXPECT_NEAR(g.mass / (kDensity * e.area), 1, 1e-14) << e.shape;
    EXPECT_NEAR(g.inertia / (g.mass * e.gyration), 1, 1e-14) << e.shape;
  }
}

// Equal and opposite first moments, corners about the centroid, anticlockwise.
TEST(GrainShape, FramesAreTheCentroids) {
  for (const char* shape : {"square", "polygon7", "rod", "L", "star"}) {
    const GrainTemplate g = grain_of(shape);
    Vec2 moment{};
    for (const GrainTriangle& t : g.triangles) {
      moment += t.mass * t.centroid;
      EXPECT_LT(norm(t.corner[0] + t.corner[1] + t.corner[2]), 1e-16);
      EXPECT_NEAR(kDensity * doubled_area(t.corner[0], t.corner[1], t.corner[2]) / 2, t.mass, 1e-15 * g.mass);
    }
    EXPECT_LT(norm(moment), 1e-15 * g.mass * kSize) << shape;
  }
}

// Rest lengths and angles: no force as built, nor after any rigid motion.
TEST(GrainShape, FreeOfLoadAsBuilt) {
  for (const char* shape : {"square", "polygon3", "rod", "L", "star"}) {
    const GrainTemplate g = grain_of(shape);
    const std::vector<double> stiffness = grain_matrices(g).stiffness;
    const double rounding = 4e-15 * *std::max_element(stiffness.begin(), stiffness.end());  // of a coordinate near 5
    for (const double turn : {0.0, 1.0, 3.0, 9.0}) {
      Coordinates x = as_built(g);
      for (std::size_t t = 0; t < x.size(); t += 3) {
        const double c = std::cos(turn), s = std::sin(turn), px = x[t], py = x[t + 1];
        x[t] = c * px - s * py + 5, x[t + 1] = s * px + c * py - 2, x[t + 2] = turn;
      }
      for (const double f : elastic_forces(g, x)) EXPECT_NEAR(f, 0, rounding);
    }
  }
}

class ShapeFile : public ::testing::Test {
 protected:
  std::string file(const std::string& text) const {
    const std::string path = folder_ / "corners.txt";
    std::ofstream(path) << text;
    return path;
  }
  std::string refusal(const std::string& name, std::optional<double> size = std::nullopt, double refine = 0) const {
    try {
      grain_shape(name, size, refine);
    } catch (const InputError& e) {
      return e.what();
    }
    return "accepted";
  }

 private:
  TemporaryFolder folder_;
};

// Whatever the triangles, the orientation and the place, mass and inertia are those of the polygon.
TEST_F(ShapeFile, ThePolygonDecidesMassAndInertia) {
  const GrainTemplate named = grain_of("L");
  for (const char* text : {"0 0\n2 0 # comment\n2 1\n\n1 1\n1 2\n0 2\n", "7,9\n7,11\n8,11\n8,10\n9,10\n9,9\n"})
    for (const double refine : {0.0, 0.05}) {
      const GrainTemplate g = grain_of(file(text), kSize / 2, refine);
      if (refine == 0)
        EXPECT_EQ(g.triangles.size(), 4u);
      else
        EXPECT_GT(g.triangles.size(), 12u);
      EXPECT_NEAR(g.mass / named.mass, 1, 1e-13);
      EXPECT_NEAR(g.inertia / named.inertia, 1, 1e-13);
      EXPECT_NEAR(g.radius / named.radius, 1, 1e-13);
    }
}

TEST_F(ShapeFile, ShippedOnesAreGrains) {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(ISOSTAT_DATA "/grains")) {
    const GrainTemplate g = grain_of(entry.path(), std::nullopt);
    EXPECT_GE(g.beams.size() + 1, g.triangles.size()) << entry.path();
    EXPECT_GT(g.mass, 0.001) << entry.path();
    EXPECT_LT(g.radius, 0.2) << entry.path();
    ++count;
  }
  EXPECT_GE(count, 4u);
}

TEST_F(ShapeFile, RefusesWhatIsNoGrain) {
  EXPECT_THAT(refusal("sqaure"), HasSubstr("did you mean square?"));
  EXPECT_THAT(refusal("blob"), HasSubstr("square, triangle, polygonN"));
  EXPECT_THAT(refusal("polygon2"), HasSubstr("polygon3 to polygon64"));
  EXPECT_THAT(refusal("polygonal"), HasSubstr("neither a shape nor a file"));
  EXPECT_THAT(refusal("no/such/file.txt"), HasSubstr("no/such/file.txt"));
  EXPECT_THAT(refusal("square", -1.0), HasSubstr("positive"));
  EXPECT_THAT(refusal("square", std::nullopt, 0.01), HasSubstr("only the polygon of a file"));
  EXPECT_THAT(refusal(file("0 0\n1 1\n1 0\n0 1\n")), HasSubstr("corners.txt:1: corner = 1: the polygon intersects"));
  EXPECT_THAT(refusal(file("0 0\n# x\n1 0\n1 1\n1 0\n")), HasSubstr("corners.txt:3: corner = 2: corners 2 and 4"));
  EXPECT_THAT(refusal(file("0 0\n1 1\n2 2\n")), HasSubstr("no area"));
  EXPECT_THAT(refusal(file("0 0\n1 0\n1 x\n1 1 1\n")), HasSubstr("corners.txt:3: corner = 1 x: two numbers"));
  EXPECT_THAT(refusal(file("0 0\n1 0\n1 x\n1 1 1\n")), HasSubstr("corners.txt:4: corner = 1 1 1"));
  EXPECT_THAT(refusal(file("# nothing\n")), HasSubstr("three corners"));
  EXPECT_THAT(refusal(file("0 0\n1 0\n1 1\n"), 1.0, 1e-4), HasSubstr("more than 10000 triangles"));
  // collinear but for the last bit: a triangle without area to rounding
  EXPECT_THROW(grain_of(file("0 0\n0.1 0.1\n0.3 0.30000000000000004\n"), 1.0), InputError);
}

TEST(GrainTemplate, RefusesImpossibleMaterials) {
  GrainMaterial m;
  m.density = 0, m.stiffness = -1, m.damping = -2;
  try {
    grain_template(grain_shape("square"), m);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_EQ(e.faults().size(), 3u);
  }
}

}  // namespace
}  // namespace isostat
