#include "analysis/structure/mean_overlap.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/gauss_legendre.hpp"

namespace isostat {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kAngles = 16;

// Angle between the shift and the branch vector at which the centres are at distance s: 0 where they are further apart
// for all directions, pi where they are closer for all.
double angle_at(double s, double d, double x) {
  const double product = (s - (d - x)) * (s + (d - x));  // 4 d x sin^2(phi / 2)
  return product <= 0 ? 0 : product >= 4 * d * x ? kPi : 2 * std::asin(std::sqrt(product / (4 * d * x)));
}

}  // namespace

double lens_area(double r, double q, double s) {
  if (s >= r + q) return 0;
  const double small = std::min(r, q);
  if (s <= std::abs(r - q)) return kPi * small * small;
  const double kite = 0.5 * std::sqrt(std::max(0.0, (r + q - s) * (r + q + s) * (s - (r - q)) * (s + (r - q))));
  // Angles by their tangents: the cosines lose half the digits in thin lenses.
  const double at_r = std::atan2(kite, 0.5 * (s * s + (r - q) * (r + q)));
  const double at_q = std::atan2(kite, 0.5 * (s * s - (r - q) * (r + q)));
  return r * r * at_r + q * q * at_q - kite;
}

double mean_overlap(double r, double q, double d, double x) {
  if (x == 0 || d == 0) return lens_area(r, q, std::max(x, d));
  const double inside = angle_at(std::abs(r - q), d, x), outside = angle_at(r + q, d, x), small = std::min(r, q);
  static const auto rule = gauss_legendre(kAngles);
  const double half = 0.5 * (outside - inside), middle = 0.5 * (outside + inside);
  double sum = inside * kPi * small * small;
  if (!(half > 0)) return sum / kPi;
  for (std::size_t n = 0; n < rule.node.size(); ++n) {
    const double t = 0.5 * kPi * rule.node[n], phi = middle + half * std::sin(t), chord = std::sin(0.5 * phi);
    const double s = std::sqrt((d - x) * (d - x) + 4 * d * x * chord * chord);
    sum += rule.weight[n] * 0.5 * kPi * std::cos(t) * half * lens_area(r, q, s);
  }
  return sum / kPi;
}

}  // namespace isostat
