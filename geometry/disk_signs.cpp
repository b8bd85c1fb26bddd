#include "geometry/disk_signs.hpp"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>

namespace isostat {
namespace {

using Rational = boost::multiprecision::cpp_rational;

// Each bound below counts the roundings of its expression generously: kRoundings * 2^-53 * (sum of magnitudes).
constexpr double kRoundings = 40;
constexpr double kUnit = 0x1p-53;

int sign(double v) { return (v > 0) - (v < 0); }

template <class Real>
Real gap_expression(const Real& dx, const Real& dy, const Real& reach) {
  return dx * dx + dy * dy - reach * reach;
}

template <class Real>
Real orthoradius_expression(const Real& ax, const Real& ay, const Real& bx, const Real& by, const Real& w0,
                            const Real& wa, const Real& wb) {
  const Real qa = ax * ax + ay * ay - wa + w0, qb = bx * bx + by * by - wb + w0;
  const Real cross = ax * by - ay * bx, u = qa * by - qb * ay, v = ax * qb - bx * qa;
  return u * u + v * v - 4 * cross * cross * w0;
}

template <class Real>
Real edge_centre_expression(const Real& dx, const Real& dy, const Real& tx, const Real& ty, const Real& w0,
                            const Real& wd, const Real& wt) {
  const Real d2 = dx * dx + dy * dy;
  return d2 * (tx * tx + ty * ty - wt + w0) - (tx * dx + ty * dy) * (d2 + w0 - wd);
}

}  // namespace

int gap_sign(const Vec2& p, const Vec2& q, std::int64_t nx, std::int64_t ny, const PeriodicCell<2>& cell,
             double radius_p, double radius_q, double tolerance) {
  const double cx = static_cast<double>(nx), cy = static_cast<double>(ny);
  const Vec2& length = cell.length;
  const double dx = (q[0] - p[0]) + cx * length[0] + cy * cell.tilt, dy = (q[1] - p[1]) + cy * length[1];
  const double reach = radius_p + radius_q + tolerance;
  const double value = gap_expression(dx, dy, reach);
  const double scale_x = std::abs(q[0]) + std::abs(p[0]) + std::abs(cx) * length[0] + std::abs(cy * cell.tilt);
  const double scale_y = std::abs(q[1]) + std::abs(p[1]) + std::abs(cy) * length[1];
  // dx is off by at most 4 units of scale_x, hence dx^2 by 4 units of scale_x (2 |dx| + ...).
  const double bound = kRoundings * kUnit * (scale_x * std::abs(dx) + scale_y * std::abs(dy) + reach * reach) +
                       kRoundings * kUnit * kUnit * (scale_x * scale_x + scale_y * scale_y);
  if (std::abs(value) > bound) return sign(value);
  const Rational ex =
      Rational(q[0]) - Rational(p[0]) + Rational(nx) * Rational(length[0]) + Rational(ny) * Rational(cell.tilt);
  const Rational ey = Rational(q[1]) - Rational(p[1]) + Rational(ny) * Rational(length[1]);
  return gap_expression<Rational>(ex, ey, Rational(radius_p) + Rational(radius_q) + Rational(tolerance)).sign();
}

int orthoradius_sign(const Vec2& a, const Vec2& b, double w0, double wa, double wb) {
  const double value = orthoradius_expression(a[0], a[1], b[0], b[1], w0, wa, wb);
  const double m = std::max({std::abs(a[0]), std::abs(a[1]), std::abs(b[0]), std::abs(b[1])});
  const double q = 2 * m * m + std::abs(w0) + std::max(std::abs(wa), std::abs(wb));
  if (std::abs(value) > kRoundings * kUnit * (8 * m * m * q * q + 16 * m * m * m * m * std::abs(w0)))
    return sign(value);
  return orthoradius_expression<Rational>(Rational(a[0]), Rational(a[1]), Rational(b[0]), Rational(b[1]), Rational(w0),
                                          Rational(wa), Rational(wb))
      .sign();
}

int edge_centre_sign(const Vec2& d, const Vec2& t, double w0, double wd, double wt) {
  const double value = edge_centre_expression(d[0], d[1], t[0], t[1], w0, wd, wt);
  const double m = std::max({std::abs(d[0]), std::abs(d[1]), std::abs(t[0]), std::abs(t[1])});
  const double q = 2 * m * m + std::abs(w0) + std::max(std::abs(wd), std::abs(wt));
  if (std::abs(value) > kRoundings * kUnit * 4 * m * m * q) return sign(value);
  return edge_centre_expression<Rational>(Rational(d[0]), Rational(d[1]), Rational(t[0]), Rational(t[1]), Rational(w0),
                                          Rational(wd), Rational(wt))
      .sign();
}

}  // namespace isostat
