#include "tests/oracle/direct_transform.hpp"

#include <cmath>
#include <numbers>

#include "tests/oracle/arc_arrangement.hpp"

namespace isostat::oracle {

std::complex<double> sum_over_disks(const Disks& d, const Vec2& k) {
  const double wave = norm(k);
  std::complex<double> sum = 0;
  for (std::size_t i = 0; i < d.centre.size(); ++i) {
    const double r = d.radius[i];
    sum += (wave > 0 ? 2 * std::numbers::pi * r * ::j1(wave * r) / wave : std::numbers::pi * r * r) *
           std::polar(1.0, -dot(k, d.centre[i]));
  }
  return sum;
}

std::complex<double> boundary_integral(const Disks& d, const Vec2& k) {
  std::complex<double> sum = 0;
  for (const auto& arc : wall_arcs(d)) {
    // Midpoint panels with Simpson's rule, fine enough for 1e-10.
    const int panels = 2 * (20 + static_cast<int>(40 * arc.sweep * (1 + norm(k) * arc.radius)));
    for (int m = 0; m <= panels; ++m) {
      const double angle = arc.start + arc.sweep * m / panels, weight = (m == 0 || m == panels ? 1
                                                                         : m % 2               ? 4
                                                                                               : 2) *
                                                                        arc.sweep / panels / 3;
      const Vec2 n{std::cos(angle), std::sin(angle)};
      sum += weight * arc.radius * dot(k, n) * std::polar(1.0, -dot(k, arc.centre + arc.radius * n));
    }
  }
  return std::complex<double>(0, 1) / dot(k, k) * sum;
}

}  // namespace isostat::oracle
