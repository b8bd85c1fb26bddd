// What the time series says of grains of triangles in a container: against sums over the grains themselves.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dem/scene/file.hpp"
#include "dem/state/container_region.hpp"
#include "dem/triangles/at_rest.hpp"
#include "dem/triangles/sample.hpp"
#include "dem/triangles/series.hpp"

namespace isostat {
namespace {

State<TriangleGrains> placed(const std::string& keys) {
  return place_triangles(parse_scene("system = \"triangles\"\n" + keys, "scene.toml", {}, SceneChecks::keys), 3);
}

double column(const State<TriangleGrains>& s, std::string_view name) {
  for (const SeriesColumn& c : series_columns(s, false))
    if (c.name == name) return c.value;
  return std::numeric_limits<double>::quiet_NaN();
}

TEST(TriangleSeries, SlicesOfAHopperHoldAllItsGrains) {
  State<TriangleGrains> s = placed(
      "gravity = 981.0\n[grains]\ncount = 60\n[container]\nshape = \"hopper\"\nwidth = 2.0\nheight = 3.0\n"
      "opening = 0.5\n[[stage]]\nuntil = \"time\"\n");
  const ContainerScene& c = s.scene.container;
  const auto held = [&] {
    const double slice = region_top(c) / 16;
    double area = 0;
    for (int k = 0; k < 16; ++k)
      area += column(s, "Phi_" + std::string(k < 9 ? "0" : "") + std::to_string(k + 1)) *
              (area_below(c, (k + 1) * slice) - area_below(c, k * slice));
    return area;
  };
  double area = 0;
  for (std::size_t g = 0; g < s.packing.grains.size(); ++g)
    if (s.packing.grains.part[g] == GrainPart::free) area += grain_area(s.packing, g);
  EXPECT_NEAR(held(), area, 1e-12);
  EXPECT_EQ(column(s, "grains"), 60);
  EXPECT_EQ(column(s, "grains_above"), 60);

  // Slices stand and fall with a hopper that has moved.
  s.surroundings.start_offset = {{0, -0.5}};
  for (Vec2& r : s.packing.bodies.position) r[1] -= 0.5;
  EXPECT_NEAR(held(), area, 1e-12);
  EXPECT_TRUE(std::isnan(column(s, "inclination_mass")));
}

TEST(TriangleSeries, InclinationOfADrumTurnsWithItsGrains) {
  State<TriangleGrains> s = placed(
      "gravity = 981.0\n[grains]\ncount = 60\nsize_max = 0.15\n[container]\nshape = \"drum\"\nradius = 1.0\n"
      "[[stage]]\nuntil = \"time\"\n");
  const double before = column(s, "inclination_mass"), surface = column(s, "inclination_surface");
  EXPECT_NEAR(before, 0, 15);  // placed in the lower part, symmetric but for chance
  EXPECT_TRUE(std::isfinite(surface));
  const double turn = std::numbers::pi / 9;
  for (Vec2& r : s.packing.bodies.position)
    r = {{std::cos(turn) * r[0] - std::sin(turn) * r[1], std::sin(turn) * r[0] + std::cos(turn) * r[1]}};
  EXPECT_NEAR(column(s, "inclination_mass"), before + 20, 1e-9);
  EXPECT_GT(column(s, "inclination_surface"), surface + 10);
  EXPECT_TRUE(std::isnan(column(s, "grains_left")));
}

}  // namespace
}  // namespace isostat
