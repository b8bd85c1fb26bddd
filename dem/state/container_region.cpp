#include "dem/state/container_region.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace isostat {
namespace {

double steepness(const ContainerScene& c) { return std::tan(c.angle * std::numbers::pi / 180); }

}  // namespace

double slope_height(const ContainerScene& c) {
  return c.shape == ContainerShape::hopper ? 0.5 * (c.width - c.opening) * steepness(c) : 0.0;
}

double region_bottom(const ContainerScene& c) { return c.shape == ContainerShape::drum ? -c.radius : 0.0; }

double region_top(const ContainerScene& c) {
  return c.shape == ContainerShape::drum ? c.radius : slope_height(c) + c.height;
}

double half_width(const ContainerScene& c) { return c.shape == ContainerShape::drum ? c.radius : 0.5 * c.width; }

bool holds(const ContainerScene& c, const Vec2& r, double radius) {
  if (c.shape == ContainerShape::drum) return norm(r) <= c.radius - radius;
  if (std::abs(r[0]) > 0.5 * c.width - radius || r[1] < radius || r[1] > region_top(c) - radius) return false;
  if (c.shape != ContainerShape::hopper) return true;
  // Above the line through (opening/2, 0) that rises outwards, by `radius`.
  const double t = c.angle * std::numbers::pi / 180;
  return r[1] * std::cos(t) - (std::abs(r[0]) - 0.5 * c.opening) * std::sin(t) >= radius;
}

double area_below(const ContainerScene& c, double y) {
  const double h = std::clamp(y, region_bottom(c), region_top(c));
  if (c.shape == ContainerShape::drum) {  // a segment of the circle
    const double s = std::clamp(h / c.radius, -1.0, 1.0);
    return c.radius * c.radius * (std::numbers::pi / 2 + std::asin(s) + s * std::sqrt(1 - s * s));
  }
  const double slopes = std::min(h, slope_height(c));
  const double below = slopes > 0 ? slopes * (c.opening + slopes / steepness(c)) : 0.0;
  return below + (h - slopes) * c.width;
}

double height_of_area(const ContainerScene& c, double area) {
  double low = region_bottom(c), high = region_top(c);
  if (area >= area_below(c, high)) return high;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (area_below(c, middle) < area ? low : high) = middle;
  }
  return high;
}

}  // namespace isostat
