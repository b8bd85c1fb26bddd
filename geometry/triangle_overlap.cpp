#include "geometry/triangle_overlap.hpp"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>

#include "geometry/base/index.hpp"
#include "geometry/double_double.hpp"

namespace isostat {
namespace {

using Rational = boost::multiprecision::cpp_rational;
constexpr double kUnit = 0x1p-53;
constexpr int next(int k) { return TriangleSigns::next(k); }

double to_double(const DoubleDouble& x) { return x.hi; }

// To nearest but for 2^-9 of an ulp: the quotient's first 62 bits are cut, and rounded once.
double to_double(const Rational& x) {
  using boost::multiprecision::msb;
  if (x.is_zero()) return 0;
  boost::multiprecision::cpp_int n = abs(numerator(x)), d = denominator(x);
  const int shift = 61 - (static_cast<int>(msb(n)) - static_cast<int>(msb(d)));
  (shift > 0 ? n : d) <<= std::abs(shift);
  const double size = std::ldexp(static_cast<double>(static_cast<std::int64_t>(n / d)), -shift);
  return x.sign() < 0 ? -size : size;
}

DoubleDouble difference(double x, double y, DoubleDouble) { return two_sum(x, -y); }
Rational difference(double x, double y, const Rational&) { return Rational(x) - Rational(y); }

template <class Real>
struct Point {
  Real x, y;
  friend Point operator-(const Point& p, const Point& q) { return {p.x - q.x, p.y - q.y}; }
};
template <class Real>
Real cross_product(const Point<Real>& p, const Point<Real>& q) {
  return p.x * q.y - p.y * q.x;
}
template <class Real>
Vec2 to_vec(const Point<Real>& p) {
  return {to_double(p.x), to_double(p.y)};
}

template <class Real>
struct Polygon {
  std::array<Point<Real>, 3> a, b;  // corners of the triangles relative to corner 0 of A
  std::array<Point<Real>, 6> vertex;
  int count = 0;
  Real twice_area{};
  double least_turn = std::numeric_limits<double>::infinity();  // |U x w| of the edges that cross
};

template <class Real>
Polygon<Real> polygon(const TriangleSigns& s, const OverlapBoundary& boundary) {
  Polygon<Real> p;
  const Vec2& o = s.a.corner[0];
  const auto relative = [&](const Vec2& c) {
    return Point<Real>{difference(c[0], o[0], Real()), difference(c[1], o[1], Real())};
  };
  for (int k = 0; k < 3; ++k) p.a[idx(k)] = relative(s.a.corner[idx(k)]), p.b[idx(k)] = relative(s.b.corner[idx(k)]);
  p.count = boundary.count;
  for (int k = 0; k < p.count; ++k) {
    const OverlapCorner& v = boundary.side[idx(k)].start;
    Point<Real>& at = p.vertex[idx(k)];
    if (v.kind == CornerKind::corner_a) {
      at = p.a[idx(v.a)];
    } else if (v.kind == CornerKind::corner_b) {
      at = p.b[idx(v.b)];
    } else {
      const Point<Real>& start = p.a[idx(v.a)];
      const Point<Real> u = p.a[idx(next(v.a))] - start, w = p.b[idx(next(v.b))] - p.b[idx(v.b)];
      const Real turn = cross_product(u, w);
      const Real t = cross_product(p.b[idx(v.b)] - start, w) / turn;
      at = {start.x + t * u.x, start.y + t * u.y};
      p.least_turn = std::min(p.least_turn, std::abs(to_double(turn)));
    }
  }
  for (int k = 1; k + 1 < p.count; ++k) {
    const Point<Real> to = p.vertex[idx(k)] - p.vertex[0], from = p.vertex[idx(k + 1)] - p.vertex[0];
    p.twice_area = p.twice_area + cross_product(to, from);
  }
  return p;
}

// Error bound of the polygon in DoubleDouble. M: the largest |coordinate| relative to the origin, so |U|, |w|
// components and differences are at most 2 M. Numerator and turn have two products of at most 4 M^2, with errors of 5
// u^2 of the product, 3 u^2 of each factor and of the difference: each less than 2 (4 M^2)(5 + 6) u^2 + 3 u^2 (8 M^2) <
// 128 u^2 M^2. With t in [0, 1] then |dt| < (2 * 128 M^2 / |turn| + 15) u^2, and a corner is off by 2 M |dt| + 16 u^2 M
// in each component, which with |turn| <= 8 M^2 is less than 1024 u^2 M^3 / |turn|; four times that is taken. To first
// order the area moves by sqrt(2) times the shift times half the perimeter of the midpoints' polygon; the fan's own
// roundings are less than 100 u^2 perimeter^2 < 1000 u^2 perimeter M, which the factor 4 covers as |turn| <= 8 M^2.
struct PolygonError {
  double corner, area;
};
PolygonError error_bound(const Polygon<DoubleDouble>& p) {
  double extent = 0, perimeter = 0;
  for (const auto* corners : {&p.a, &p.b})
    for (const auto& c : *corners) extent = std::max({extent, std::abs(c.x.hi), std::abs(c.y.hi)});
  for (int k = 0; k < p.count; ++k)
    perimeter += norm(to_vec(p.vertex[idx(k + 1 == p.count ? 0 : k + 1)] - p.vertex[idx(k)]));
  const double square = extent * extent, turn = std::min(p.least_turn, 8 * square);
  if (!(extent > 0x1p-300 && extent < 0x1p300 && turn > 0))  // products would leave the range
    return {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  const double corner = 4096 * kUnit * kUnit * extent * (square / turn);
  return {corner, 4 * corner * perimeter + 16 * corner * corner};
}

template <class Real>
void measure(TriangleOverlap& out, const TriangleSigns& s, const OverlapBoundary& boundary, const Polygon<Real>& p) {
  const auto label = [](int k, bool turned, bool edge) {  // in the caller's numbers
    constexpr std::uint8_t edges[] = {2, 1, 0}, corners[] = {0, 2, 1};
    return !turned ? static_cast<std::uint8_t>(k) : edge ? edges[k] : corners[k];
  };
  out.area = to_double(p.twice_area) / 2;
  out.side_count = p.count;
  for (int k = 0; k < p.count; ++k) {
    const OverlapEdge& side = boundary.side[idx(k)];
    const bool at_crossing = side.start.kind == CornerKind::crossing;
    out.side_store[idx(k)] = {.owner = side.owner,
                              .edge = label(side.edge, side.owner == Owner::a ? s.a_turned : s.b_turned, true),
                              .start_kind = side.start.kind,
                              .start_a = label(side.start.a, s.a_turned, at_crossing),
                              .start_b = label(side.start.b, s.b_turned, at_crossing),
                              .start = to_vec(p.vertex[idx(k)]),
                              .along = to_vec(p.vertex[idx(k + 1 == p.count ? 0 : k + 1)] - p.vertex[idx(k)])};
  }
  const auto add_chord = [&](int from, int to) {
    const Vec2 along = to_vec(p.vertex[idx(to)] - p.vertex[idx(from)]);
    out.chord_store[idx(out.chord_count++)] = {to_vec(p.vertex[idx(from)]), along, norm(along)};
  };
  if (s.type == OverlapType::i || s.type == OverlapType::ii) {
    for (int k = 1; k < p.count; ++k)
      if (boundary.side[idx(k)].start.kind == CornerKind::crossing) add_chord(0, k);
  } else if (s.type == OverlapType::iii) {
    add_chord(0, 1), add_chord(0, 3);
  }
}

// Moments about the centroids; the midpoints are taken relative to a corner of the overlap first, so that a small
// overlap far from the centroid keeps what precision its sides have.
void add_gradients(TriangleOverlap& out, const TriangleSigns& s) {
  if (out.side_count == 0) return;
  const Vec2 reference = out.side_store[0].start;
  Vec2 sum_a, sum_b;  // of the sides of each
  double moment_a = 0, moment_b = 0;
  for (const OverlapSide& side : out.sides()) {
    const double moment = dot(side.start - reference + 0.5 * side.along, side.along);
    (side.owner == Owner::a ? sum_a : sum_b) += side.along;
    (side.owner == Owner::a ? moment_a : moment_b) += moment;
  }
  const auto arm = [&](const Triangle& t) {  // from the centroid to the reference
    const Vec2 c = (t.corner[0] - out.origin) + (t.corner[1] - out.origin) + (t.corner[2] - out.origin);
    return reference - (1.0 / 3) * c;
  };
  out.gradient_a = {{sum_a[1], -sum_a[0]}, -moment_a - dot(arm(s.a), sum_a)};
  out.gradient_b = {{-sum_a[1], sum_a[0]}, -moment_b + dot(arm(s.b), sum_a)};
}

}  // namespace

TriangleOverlap triangle_overlap(const Triangle& a, const Triangle& b) {
  const TriangleSigns signs = triangle_signs(a, b);
  TriangleOverlap out;
  out.type = signs.type, out.origin = a.corner[0];
  if (out.type == OverlapType::separate || out.type == OverlapType::touch) return out;
  const OverlapBoundary boundary = overlap_boundary(signs);
  const auto p = polygon<DoubleDouble>(signs, boundary);
  const PolygonError error = error_bound(p);
  if (error.area <= kUnit / 8 * p.twice_area.hi)
    measure(out, signs, boundary, p);
  else
    measure(out, signs, boundary, polygon<Rational>(signs, boundary));
  add_gradients(out, signs);
  return out;
}

}  // namespace isostat
