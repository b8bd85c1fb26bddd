#include "geometry/overlap_points.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace isostat {
namespace {

// Height over the common chord of the minor arc that it cuts off, sqrt(r^2 - v^2) - |f| with |f|^2 + s^2 = r^2, in
// the form that does not cancel in thin lenses; negative where the arc lies on the other side of the chord.
double rise(double r, double s, double v, double foot) {
  const double height = (s - v) * (s + v) / (std::sqrt(std::max(0.0, (r - v) * (r + v))) + std::abs(foot));
  return foot < 0 ? -height : height;
}

}  // namespace

// Points are spread across the lens or crescent along the branch vector and along its chord.
std::array<double, 2> OverlapPoints::lens(const Vec2& p, const Vec2& branch, double r, double q, double weight) {
  const double d = norm(branch), product = (r + q - d) * (r + q + d) * (d - (r - q)) * (d + (r - q));
  const double foot_p = (d * d + (r - q) * (r + q)) / (2 * d), foot_q = d - foot_p;
  const std::array<double, 2> whole{foot_p < 0 ? weight : 0, foot_q < 0 ? weight : 0};
  if (!(product > 0)) return whole;
  const double s = std::sqrt(product) / (2 * d), width = r + q - d;
  const Vec2 n = (1 / d) * branch, t{-n[1], n[0]};
  const double share = s * width / (r * r);
  if (share < tolerance_) return whole;
  // Shallow lenses are parabolas along the chord (two points are exact for the area, three for the next order); for
  // deep ones v = s sin(tau) takes the roots at the ends away.
  const double depth = s / std::min(r, q);
  const bool deep = depth > 0.3;
  const int across = points_for(0.5 * k_max_ * width, share);
  const int along = points_for(k_max_ * s, share) + (deep ? 12 : share * depth * depth < tolerance_ ? 1 : 2);
  const Quadrature &qu = rule(across), &qv = rule(along);
  const double stretch = deep ? std::numbers::pi / 2 : 1;
  for (std::size_t a = 0; a < qv.node.size(); ++a) {
    const double tau = stretch * qv.node[a], v = s * (deep ? std::sin(tau) : tau);
    const double dv = s * stretch * qv.weight[a] * (deep ? std::cos(tau) : 1);
    const double right = rise(r, s, v, foot_p), left = rise(q, s, v, foot_q);
    const double mid = foot_p + 0.5 * (right - left), half = 0.5 * (right + left);
    for (std::size_t b = 0; b < qu.node.size(); ++b)
      add(p + (mid + half * qu.node[b]) * n + v * t, weight * dv * half * qu.weight[b]);
  }
  return whole;
}

// Gauss points that integrate exp(i x), |x| <= phase, with an error below tolerance / share.
int OverlapPoints::points_for(double phase, double share) const {
  double term = share;
  int n = 0;
  do {
    ++n;
    term *= phase * phase / (2.0 * n * (2.0 * n - 1)) / 4;
  } while (term > tolerance_ && n < 200);
  return n;
}

const Quadrature& OverlapPoints::rule(int n) {
  auto& r = rules_[n];
  if (r.node.empty()) r = gauss_legendre(n);
  return r;
}

}  // namespace isostat
