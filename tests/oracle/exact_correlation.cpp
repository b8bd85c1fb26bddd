#include "tests/oracle/exact_correlation.hpp"

#include <cmath>
#include <numbers>

#include "geometry/pores.hpp"

namespace isostat::oracle {

double exact_correlation(const Disks& disks, double r, int directions) {
  const double once = find_pores(disks.centre, disks.radius, disks.cell).covered_area;
  auto radius = disks.radius;
  radius.insert(radius.end(), disks.radius.begin(), disks.radius.end());
  double sum = 0;
  for (int n = 0; n < directions; ++n) {
    const double angle = std::numbers::pi * (n + 0.5) / directions;  // r and -r are alike
    auto centre = disks.centre;
    for (const auto& c : disks.centre) centre.push_back(c + r * Vec2{std::cos(angle), std::sin(angle)});
    sum += 2 * once - find_pores(centre, radius, disks.cell).covered_area;
  }
  return sum / directions / disks.cell.measure();
}

}  // namespace isostat::oracle
