// Readings of grains in a container: inclination of a surface, density by height, the room inside.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "dem/solver/random.hpp"
#include "dem/state/container_region.hpp"
#include "dem/state/density_profile.hpp"
#include "dem/state/inclination.hpp"

namespace isostat {
namespace {

constexpr double kPi = std::numbers::pi;

// Points fill the lower half of a circle, turned anticlockwise by an angle.
std::vector<Vec2> half_filled(double angle, const Vec2& middle) {
  std::vector<Vec2> points;
  const double c = std::cos(angle), s = std::sin(angle);
  for (int i = -60; i <= 60; ++i)
    for (int j = -60; j <= 0; ++j) {
      const double x = i / 60.0 * 2, y = j / 60.0 * 2;
      if (x * x + y * y <= 4) points.push_back(middle + Vec2{{c * x - s * y, s * x + c * y}});
    }
  return points;
}

TEST(Inclination, OfAHalfFilledDrumIsItsTurn) {
  for (const double angle : {-0.4, 0.0, 0.25, 0.6}) {
    const Vec2 middle{{0.5, -1}};
    const std::vector<Vec2> points = half_filled(angle, middle);
    const std::vector<double> mass(points.size(), 0.3);
    const Inclination i = inclination(points, mass, middle, 2);
    EXPECT_NEAR(i.centre_of_mass, angle, 1e-12) << angle;
    EXPECT_NEAR(i.surface, angle, 0.02) << angle;
  }
}

TEST(Inclination, OfNothingIsNotANumber) {
  const Inclination i = inclination({}, {}, {}, 1);
  EXPECT_TRUE(std::isnan(i.surface));
  EXPECT_TRUE(std::isnan(i.centre_of_mass));
}

TEST(DensityProfile, SumsWhatLiesInEachSlice) {
  const std::vector<Vec2> position{{{0, 0.1}}, {{5, 0.4}}, {{1, 1.9}}, {{0, -0.1}}, {{0, 2}}};
  const std::vector<double> weight{1, 2, 4, 100, 100};
  EXPECT_EQ(density_profile(position, weight, 0, 2, 4), (std::vector<double>{6, 0, 0, 8}));
}

ContainerScene of(ContainerShape shape) {
  ContainerScene c;
  c.shape = shape;
  c.width = 5, c.height = 3, c.opening = 1, c.angle = 60, c.radius = 2.5;
  return c;
}

// The room's area by throwing points at it, and a circle that just fits.
TEST(ContainerRegion, AreaAndInsideAgree) {
  for (const ContainerShape shape : {ContainerShape::box, ContainerShape::hopper, ContainerShape::drum}) {
    const ContainerScene c = of(shape);
    const double bottom = region_bottom(c), top = region_top(c), half = half_width(c);
    Random random(3);
    const double y = bottom + 0.4 * (top - bottom);
    int inside = 0, below = 0;
    constexpr int kThrows = 200000;
    for (int k = 0; k < kThrows; ++k) {
      const Vec2 r{{half * (2 * random.uniform() - 1), bottom + (top - bottom) * random.uniform()}};
      const bool in = holds(c, r, 0);
      inside += in, below += in && r[1] < y;
    }
    const double box = 2 * half * (top - bottom);
    EXPECT_NEAR(box * inside / kThrows, area_below(c, top), 0.01 * box);
    EXPECT_NEAR(box * below / kThrows, area_below(c, y), 0.01 * box);
    EXPECT_NEAR(height_of_area(c, area_below(c, y)), y, 1e-9);
    EXPECT_EQ(height_of_area(c, 2 * box), top);
  }
}

TEST(ContainerRegion, ACircleTouchesNoWall) {
  const ContainerScene hopper = of(ContainerShape::hopper);
  EXPECT_NEAR(slope_height(hopper), 2 * std::tan(kPi / 3), 1e-12);
  EXPECT_TRUE(holds(hopper, {{0, 0.5}}, 0.49));
  EXPECT_FALSE(holds(hopper, {{0, 0.5}}, 0.51));  // the lid
  // A radius of .3 off the slope, at right angles to it, half way up.
  const Vec2 on{{0.5 + 1, std::tan(kPi / 3)}}, normal{{-std::sin(kPi / 3), std::cos(kPi / 3)}};
  EXPECT_TRUE(holds(hopper, on + 0.301 * normal, 0.3));
  EXPECT_FALSE(holds(hopper, on + 0.299 * normal, 0.3));
  EXPECT_TRUE(holds(of(ContainerShape::drum), {{0, -2}}, 0.5));
  EXPECT_FALSE(holds(of(ContainerShape::drum), {{1.5, 1.5}}, 0.5));
}

}  // namespace
}  // namespace isostat
