#include "tests/support/triangle_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace isostat::oracle {
namespace {

using Random = std::mt19937_64;

double uniform(Random& r, double low = 0, double high = 1) {
  return std::uniform_real_distribution<double>(low, high)(r);
}
int integer(Random& r, int low, int high) { return std::uniform_int_distribution<int>(low, high)(r); }
std::size_t any_corner(Random& r) { return static_cast<std::size_t>(integer(r, 0, 2)); }
Vec2 in_square(Random& r) { return {uniform(r), uniform(r)}; }
Triangle any_triangle(Random& r) { return {{in_square(r), in_square(r), in_square(r)}}; }
Vec2 between(const Vec2& p, const Vec2& q, double t) { return p + t * (q - p); }

double signed_area(const Triangle& t) {
  const Vec2 u = t.corner[1] - t.corner[0], v = t.corner[2] - t.corner[0];
  return (u[0] * v[1] - u[1] * v[0]) / 2;
}

void nudge_corners(Triangle& t, int most, Random& r) {
  for (Vec2& c : t.corner)
    for (int k = 0; k < 2; ++k)
      for (int n = integer(r, -most, most); n != 0; n -= n > 0 ? 1 : -1)
        c[k] = std::nextafter(c[k], n > 0 ? 1e9 : -1e9);
}

TrianglePair shared(Random& r) {
  TrianglePair p{any_triangle(r), any_triangle(r)};
  const std::size_t k = any_corner(r), l = any_corner(r);
  p.b.corner[l] = p.a.corner[k];
  if (integer(r, 0, 1)) p.b.corner[(l + 1) % 3] = p.a.corner[(k + 1) % 3];
  return p;
}

TrianglePair collinear(Random& r) {
  TrianglePair p{any_triangle(r), any_triangle(r)};
  const Vec2 u = p.a.corner[0], v = p.a.corner[1];
  p.b.corner[0] = between(u, v, uniform(r, -1, 2)), p.b.corner[1] = between(u, v, uniform(r, -1, 2));
  return p;
}

TrianglePair nested(Random& r) {
  TrianglePair p{any_triangle(r), {}};
  for (Vec2& c : p.b.corner) {
    double s = uniform(r), t = uniform(r);
    if (s + t > 1) s = 1 - s, t = 1 - t;
    if (integer(r, 0, 2) == 0) s = 0;
    if (integer(r, 0, 4) == 0) t = 0;
    c = p.a.corner[0] + s * (p.a.corner[1] - p.a.corner[0]) + t * (p.a.corner[2] - p.a.corner[0]);
  }
  return p;
}

Triangle sliver(Random& r) {
  Triangle t = any_triangle(r);
  t.corner[2] = between(t.corner[0], t.corner[1], uniform(r, 0.2, 0.8));
  t.corner[2] += std::pow(10, uniform(r, -14, -2)) * in_square(r);
  return t;
}

Triangle flat(Random& r) {
  const Vec2 u = {double(integer(r, 0, 4)), double(integer(r, 0, 4))};
  const int dx = integer(r, -2, 2), dy = integer(r, -2, 2);
  const auto along = [&](int n) { return Vec2{u[0] + n * dx, u[1] + n * dy}; };
  return {{along(integer(r, -1, 1)), along(integer(r, -2, 2)), u}};
}

Triangle lattice(Random& r) {
  Triangle t;
  do
    for (Vec2& c : t.corner) c = {double(integer(r, 0, 4)), double(integer(r, 0, 4))};
  while (signed_area(t) == 0);
  return t;
}

TrianglePair of_kind(PairKind kind, Random& r) {
  switch (kind) {
    case PairKind::random:
      return {any_triangle(r), any_triangle(r)};
    case PairKind::shallow:
      return corner_into_edge((integer(r, 0, 3) ? 1 : -1) * std::pow(10, uniform(r, -12, -1)), r);
    case PairKind::lattice:
      return {lattice(r), lattice(r)};
    case PairKind::shared:
      return shared(r);
    case PairKind::on_edge: {
      TrianglePair p{any_triangle(r), any_triangle(r)};
      const std::size_t k = any_corner(r);
      p.b.corner[any_corner(r)] = between(p.a.corner[k], p.a.corner[(k + 1) % 3], uniform(r));
      return p;
    }
    case PairKind::collinear:
      return collinear(r);
    case PairKind::nested:
      return nested(r);
    case PairKind::identical: {
      const Triangle t = any_triangle(r);
      return {t, t};
    }
    case PairKind::sliver:
      return {sliver(r), integer(r, 0, 1) ? sliver(r) : any_triangle(r)};
    case PairKind::flat:
      return {flat(r), lattice(r)};
  }
  return {};
}

}  // namespace

std::string_view name(PairKind kind) {
  constexpr std::string_view names[] = {"random",    "shallow", "lattice",   "shared", "on_edge",
                                        "collinear", "nested",  "identical", "sliver", "flat"};
  return names[static_cast<int>(kind)];
}

TrianglePair triangle_pair(PairKind kind, int nudge, Random& r) {
  TrianglePair p = of_kind(kind, r);
  if (nudge > 0) nudge_corners(p.a, nudge, r), nudge_corners(p.b, nudge, r);
  for (Triangle* t : {&p.a, &p.b}) {
    std::rotate(t->corner.begin(), t->corner.begin() + integer(r, 0, 2), t->corner.end());
    if (integer(r, 0, 1)) std::swap(t->corner[0], t->corner[1]);
  }
  if (integer(r, 0, 1)) std::swap(p.a, p.b);
  return p;
}

TrianglePair corner_into_edge(double depth, Random& r) {
  constexpr double third = 2 * std::numbers::pi / 3, apothem = 0.5;
  const double turn = uniform(r, 0, 2 * std::numbers::pi), tilt = uniform(r, -0.7, 0.7);
  const double off = uniform(r, -0.6, 0.6);
  TrianglePair p;
  // Edge 0 of A faces `turn`; corner 0 of B points at it.
  const Vec2 n{std::cos(turn), std::sin(turn)}, t{-n[1], n[0]};
  const Vec2 tip = (apothem - depth) * n + off * t;
  const double back = turn + std::numbers::pi + tilt;
  const Vec2 centre = tip - Vec2{std::cos(back), std::sin(back)};
  for (int k = 0; k < 3; ++k) {
    const double at_a = turn - third / 2 + k * third, at_b = back + k * third;
    p.a.corner[static_cast<std::size_t>(k)] = {std::cos(at_a), std::sin(at_a)};
    p.b.corner[static_cast<std::size_t>(k)] = centre + Vec2{std::cos(at_b), std::sin(at_b)};
  }
  return p;
}

TrianglePair moved(const TrianglePair& p, double x, double y) {
  TrianglePair q = p;
  for (Triangle* t : {&q.a, &q.b})
    for (Vec2& c : t->corner) c += Vec2{x, y};
  return q;
}

TrianglePair scaled(const TrianglePair& p, int exponent) {
  TrianglePair q = p;
  for (Triangle* t : {&q.a, &q.b})
    for (Vec2& c : t->corner) c = {std::ldexp(c[0], exponent), std::ldexp(c[1], exponent)};
  return q;
}

Triangle anticlockwise(Triangle t) {
  if (signed_area(t) < 0) std::swap(t.corner[1], t.corner[2]);
  return t;
}

}  // namespace isostat::oracle
