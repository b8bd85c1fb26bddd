#include "geometry/arc_moments.hpp"

#include <cmath>

namespace isostat {
namespace {

// Gauss-Legendre nodes and weights on [-1, 1], eight points (half of them; the rest by symmetry).
constexpr double kNode[] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
constexpr double kWeight[] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763};

// Below this sweep the closed form cancels (a short arc seen from near by: terms of the size of the disk for a result
// of the size of the arc), and eight Gauss points are exact to 2e-16.
constexpr double kShortSweep = 0.7;

// In the frame whose x axis points to the middle of the arc: position (cu + R cos f, cv + R sin f), f in [-h, h].
struct MidFrame {
  double cu, cv, h;
};

WallIntegrals short_arc(const MidFrame& m, double radius) {
  WallIntegrals s;
  const double e = m.cu + radius;  // the arc's middle: known to rounding of the disk, small when the origin is near
  for (int k = 0; k < 4; ++k) {
    const double half = std::sin(0.5 * m.h * kNode[k]), sine = std::sin(m.h * kNode[k]), drop = 2 * half * half;
    for (const double sf : {-sine, sine}) {
      const double u = e - radius * drop, v = m.cv + radius * sf;
      const double w = kWeight[k] * m.h * radius * (e - m.cu * drop + m.cv * sf);
      s.w += w, s.xw += w * u, s.yw += w * v, s.rrw += w * (u * u + v * v);
    }
  }
  return s;
}

WallIntegrals long_arc(const MidFrame& m, double r) {
  const double sine = std::sin(m.h), product = sine * std::cos(m.h);
  const double cos2 = m.h + product, sin2 = m.h - product;  // integrals of cos^2, sin^2 over [-h, h]
  WallIntegrals s;
  s.w = 2 * r * (r * m.h + m.cu * sine);
  const double wc = r * (2 * r * sine + m.cu * cos2), ws = r * m.cv * sin2;  // of w cos f, w sin f
  s.xw = m.cu * s.w + r * wc;
  s.yw = m.cv * s.w + r * ws;
  s.rrw = (m.cu * m.cu + m.cv * m.cv + r * r) * s.w + 2 * r * (m.cu * wc + m.cv * ws);
  return s;
}

}  // namespace

WallIntegrals arc_integrals(const Vec2& centre, double radius, const Vec2& start, double sweep) {
  const double h = 0.5 * sweep, c = std::cos(h), s = std::sin(h);
  const Vec2 axis{start[0] * c - start[1] * s, start[0] * s + start[1] * c};
  const MidFrame m{dot(centre, axis), axis[0] * centre[1] - axis[1] * centre[0], h};
  WallIntegrals out = std::abs(sweep) < kShortSweep ? short_arc(m, radius) : long_arc(m, radius);
  const double u = out.xw, v = out.yw;
  out.xw = axis[0] * u - axis[1] * v;
  out.yw = axis[1] * u + axis[0] * v;
  return out;
}

WallIntegrals link_integrals(const Vec2& p, const Vec2& q) {
  const double cross = p[0] * q[1] - p[1] * q[0];
  return {cross, 0.5 * cross * (p[0] + q[0]), 0.5 * cross * (p[1] + q[1]),
          cross * (dot(p, p) + dot(p, q) + dot(q, q)) / 3};
}

}  // namespace isostat
