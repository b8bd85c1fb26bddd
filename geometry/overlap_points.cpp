#include "geometry/overlap_points.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace isostat {
namespace {

// Height over the common chord of the minor arc that it cuts off, sqrt(r^2 - v^2) - |f| with |f|^2 + s^2 = r^2, in
// the form that does not cancel in thin lenses; negative where the arc lies on the other side of the chord.
double rise(double r, double s, double v, double foot) {
  const double height = (s - v) * (s + v) / (std::sqrt(std::max(0.0, (r - v) * (r + v))) + std::abs(foot));
  return foot < 0 ? -height : height;
}

struct Corner {
  Vec2 at;
  std::size_t a, b;  // whose circles cross there
};
// Crossing points of two circles that lie in the third disk.
std::vector<Corner> corners(const std::array<Vec2, 3>& p, const std::array<double, 3>& r) {
  std::vector<Corner> out;
  for (std::size_t a = 0; a < 3; ++a) {
    const std::size_t b = (a + 1) % 3, third = (a + 2) % 3;
    const Vec2 branch = p[b] - p[a];
    const double d = norm(branch);
    const double product = (r[a] + r[b] - d) * (r[a] + r[b] + d) * (d - (r[a] - r[b])) * (d + (r[a] - r[b]));
    if (!(product > 0)) continue;
    const double foot = (d * d + (r[a] - r[b]) * (r[a] + r[b])) / (2 * d), s = std::sqrt(product) / (2 * d);
    const Vec2 n = (1 / d) * branch, t{-n[1], n[0]};
    for (const double side : {-s, s}) {
      const Vec2 x = p[a] + foot * n + side * t;
      if (norm(x - p[third]) <= r[third]) out.push_back({x, a, b});
    }
  }
  return out;
}
// The disk whose arc goes from corner a to corner b anticlockwise along the region's border: of those that pass
// through both corners the one whose arc stays inside the others.
std::size_t disk_of_side(const Corner& a, const Corner& b, const std::array<Vec2, 3>& p,
                         const std::array<double, 3>& r) {
  std::size_t best = a.a;
  double best_excess = 1e300;
  for (const auto m : {a.a, a.b}) {
    if (m != b.a && m != b.b) continue;
    const Vec2 u = a.at - p[m], v = b.at - p[m];
    double sweep = std::atan2(u[0] * v[1] - u[1] * v[0], dot(u, v));
    if (sweep < 0) sweep += 2 * std::numbers::pi;
    const double c = std::cos(sweep / 2), s = std::sin(sweep / 2);
    const Vec2 top = p[m] + Vec2{u[0] * c - u[1] * s, u[0] * s + u[1] * c};
    double excess = -1e300;
    for (std::size_t o = 0; o < 3; ++o)
      if (o != m) excess = std::max(excess, norm(top - p[o]) - r[o]);
    if (excess < best_excess) best_excess = excess, best = m;
  }
  return best;
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

std::array<double, 3> OverlapPoints::triple(const std::array<Vec2, 3>& p, const std::array<double, 3>& r,
                                            double weight) {
  std::array<double, 3> whole{};
  auto corner = corners(p, r);
  if (corner.size() < 2) {  // one disk lies inside the other two
    whole[static_cast<std::size_t>(std::min_element(r.begin(), r.end()) - r.begin())] = weight;
    return whole;
  }
  Vec2 middle{};
  for (const auto& c : corner) middle += (1.0 / static_cast<double>(corner.size())) * c.at;
  std::sort(corner.begin(), corner.end(), [&](const Corner& a, const Corner& b) {
    return std::atan2(a.at[1] - middle[1], a.at[0] - middle[0]) < std::atan2(b.at[1] - middle[1], b.at[0] - middle[0]);
  });
  for (std::size_t k = 0; k < corner.size(); ++k) {
    const auto &a = corner[k], &b = corner[(k + 1) % corner.size()];
    triangle(middle, a.at, b.at, weight);
    const auto m = disk_of_side(a, b, p, r);
    const Vec2 side = b.at - a.at;
    const double length = norm(side);
    if (!(length > 0)) continue;
    const Vec2 out{side[1] / length, -side[0] / length}, foot = 0.5 * (a.at + b.at);
    const double offset = dot(foot - p[m], out);
    if (offset < 0) whole[m] += weight;
    segment(foot, out, 0.5 * length, r[m], offset, weight);
  }
  return whole;
}

void OverlapPoints::triangle(const Vec2& apex, const Vec2& b, const Vec2& c, double weight) {
  const Vec2 u = b - apex, v = c - apex;
  const double twice = u[0] * v[1] - u[1] * v[0];
  if (!(std::abs(twice) > 0)) return;
  const Quadrature& q = rule(4 + points_for(0.5 * k_max_ * std::max({norm(u), norm(v), norm(c - b)}), 1));
  for (std::size_t m = 0; m < q.node.size(); ++m) {
    const double x = 0.5 * (1 + q.node[m]);
    for (std::size_t n = 0; n < q.node.size(); ++n) {
      const double y = 0.5 * (1 + q.node[n]);
      add(apex + x * (u + y * (v - u)), weight * 0.25 * q.weight[m] * q.weight[n] * x * twice);
    }
  }
}

// Between a chord of half length s and the arc over it, on the side `out`; foot: distance of the chord from the
// disk's centre along `out`. With foot < 0 the minor segment on the other side, negative.
void OverlapPoints::segment(const Vec2& middle, const Vec2& out, double s, double r, double foot, double weight) {
  const Vec2 along{-out[1], out[0]};
  const Quadrature &qv = rule(16 + points_for(k_max_ * s, 1)), &qu = rule(2 + points_for(k_max_ * s / 2, 1));
  for (std::size_t a = 0; a < qv.node.size(); ++a) {
    const double tau = std::numbers::pi / 2 * qv.node[a], v = s * std::sin(tau);
    const double half = 0.5 * rise(r, s, v, foot), dv = s * std::numbers::pi / 2 * qv.weight[a] * std::cos(tau);
    for (std::size_t b = 0; b < qu.node.size(); ++b)
      add(middle + half * (1 + qu.node[b]) * out + v * along, weight * dv * half * qu.weight[b]);
  }
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
