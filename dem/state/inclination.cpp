#include "dem/state/inclination.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace isostat {
namespace {

// Angle of the line of least squares; not a number through fewer than three points.
double slope_angle(const std::vector<Vec2>& points) {
  if (points.size() < 3) return std::numeric_limits<double>::quiet_NaN();
  Vec2 mean{};
  for (const Vec2& p : points) mean += (1 / static_cast<double>(points.size())) * p;
  double xx = 0, xy = 0;
  for (const Vec2& p : points) {
    const Vec2 d = p - mean;
    xx += d[0] * d[0], xy += d[0] * d[1];
  }
  return std::atan2(xy, xx);
}

}  // namespace

Inclination inclination(std::span<const Vec2> position, std::span<const double> mass, const Vec2& middle,
                        double half_width) {
  // Sums in the order of the positions: storage order is the solver's business and must not show in the last bit.
  std::vector<std::size_t> order(position.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return position[a][0] != position[b][0] ? position[a][0] < position[b][0] : position[a][1] < position[b][1];
  });
  std::array<const Vec2*, kSurfaceColumns> highest{};
  const double part = kSurfacePart * half_width;
  double total = 0;
  Vec2 moment{};
  for (const std::size_t k : order) {
    const Vec2 r = position[k] - middle;
    total += mass[k], moment += mass[k] * r;
    if (!(std::abs(r[0]) < part)) continue;
    const auto c = static_cast<std::size_t>((r[0] + part) / (2 * part) * kSurfaceColumns);
    const Vec2*& top = highest[std::min(c, highest.size() - 1)];
    if (!top || position[k][1] > (*top)[1]) top = &position[k];
  }
  Inclination result;
  std::vector<Vec2> points;
  for (const Vec2* top : highest)
    if (top) points.push_back(*top);
  result.surface = slope_angle(points);
  if (total > 0) result.centre_of_mass = std::atan2(moment[0], -moment[1]);
  return result;
}

}  // namespace isostat
