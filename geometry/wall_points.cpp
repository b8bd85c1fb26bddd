#include "geometry/wall_points.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/gauss_legendre.hpp"
#include "geometry/pores.hpp"

namespace isostat {

// Gauss points on pieces of at most kLongestPiece and a phase of +-kLargestPhase, enough for exp(ik.r) up to k_max: the
// remainder of n points on a phase of +-p falls as (p/2)^2n / (2n)!, once n is beyond p/4, and overflows before where p
// is above 1400.
WallPoints wall_points(std::span<const Vec2> centre, std::span<const double> radius, const PeriodicCell<2>& cell,
                       double k_max, double tolerance) {
  constexpr double kLongestPiece = 3.2;  // [rad]
  constexpr double kLargestPhase = 200;  // [rad]
  constexpr int kForTheCurve = 6;        // points more than a straight wall needs
  const auto pores = find_pores(centre, radius, cell, {.with_arcs = true});
  WallPoints out;
  out.covered_area = pores.covered_area;
  std::vector<Quadrature> rules;
  for (const auto& arc : pores.arcs) {
    if (!(arc.sweep > 0)) continue;  // the wall of a void that is closed to rounding
    const double longest = std::min(kLongestPiece, 2 * kLargestPhase / (k_max * arc.radius));
    const double pieces = std::ceil(arc.sweep / longest), half = 0.5 * arc.sweep / pieces;
    const double phase = k_max * arc.radius * half;
    std::size_t n = 1;
    for (double rest = 1; rest > tolerance; ++n)
      rest *= phase * phase / (2.0 * static_cast<double>(n) * (2.0 * static_cast<double>(n) - 1)) / 4;
    n += half > 0.1 ? kForTheCurve : 1;
    while (rules.size() <= n)
      rules.push_back(rules.empty() ? Quadrature{} : gauss_legendre(static_cast<int>(rules.size())));
    for (double piece = 0; piece < pieces; ++piece)
      for (std::size_t k = 0; k < n; ++k) {
        const double angle = arc.start + half * (2 * piece + 1 + rules[n].node[k]);
        const Vec2 normal{std::cos(angle), std::sin(angle)};
        const double length = arc.radius * half * rules[n].weight[k];
        out.at.push_back(arc.centre + arc.radius * normal);
        out.normal_x.push_back(length * normal[0]), out.normal_y.push_back(length * normal[1]);
      }
  }
  return out;
}

}  // namespace isostat
