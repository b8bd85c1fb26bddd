#include "tests/oracle/rational_overlap.hpp"

#include <algorithm>
#include <utility>

namespace isostat::oracle {
namespace {

using Corners = std::array<RationalPoint, 3>;

// (q - p) x (r - p)
mpq_class turn(const RationalPoint& p, const RationalPoint& q, const RationalPoint& r) {
  return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
}

Corners corners_of(const Triangle& t) {
  Corners c;
  for (std::size_t k = 0; k < 3; ++k) c[k] = {mpq_class(t.corner[k][0]), mpq_class(t.corner[k][1])};
  if (turn(c[0], c[1], c[2]) < 0) std::swap(c[1], c[2]);
  return c;
}

// What of a convex polygon lies on the closed left of pq (Sutherland and Hodgman 1974).
std::vector<RationalPoint> cut(const std::vector<RationalPoint>& polygon, const RationalPoint& p,
                               const RationalPoint& q) {
  std::vector<RationalPoint> kept;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const RationalPoint &from = polygon[k], &to = polygon[(k + 1) % polygon.size()];
    const mpq_class d = turn(p, q, from), e = turn(p, q, to);
    if (d >= 0) kept.push_back(from);
    if ((d > 0 && e < 0) || (d < 0 && e > 0)) {
      const mpq_class t = d / (d - e);
      kept.push_back({from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)});
    }
  }
  return kept;
}

bool cross(const RationalPoint& p, const RationalPoint& q, const RationalPoint& r, const RationalPoint& s) {
  return sgn(turn(p, q, r)) * sgn(turn(p, q, s)) < 0 && sgn(turn(r, s, p)) * sgn(turn(r, s, q)) < 0;
}

OverlapType type_with_area(const Corners& a, const Corners& b) {
  bool on_line = false, all_a_inside = true, all_b_inside = true;
  std::array<int, 3> on_a{}, on_b{};
  for (std::size_t e = 0; e < 3; ++e)
    for (std::size_t f = 0; f < 3; ++f) {
      const std::size_t e1 = (e + 1) % 3, f1 = (f + 1) % 3;
      const mpq_class of_a = turn(b[f], b[f1], a[e]), of_b = turn(a[e], a[e1], b[f]);
      on_line = on_line || of_a == 0 || of_b == 0;
      all_a_inside = all_a_inside && of_a > 0, all_b_inside = all_b_inside && of_b > 0;
      if (cross(a[e], a[e1], b[f], b[f1])) ++on_a[e], ++on_b[f];
    }
  if (on_line || all_a_inside || all_b_inside) return OverlapType::degenerate;
  std::sort(on_a.begin(), on_a.end()), std::sort(on_b.begin(), on_b.end());
  using Counts = std::array<int, 3>;
  if (on_a == Counts{0, 0, 2} || on_b == Counts{0, 0, 2}) return OverlapType::i;
  if (on_a == Counts{0, 1, 1} && on_b == Counts{0, 1, 1}) return OverlapType::ii;
  if (on_a == Counts{0, 2, 2} && on_b == Counts{0, 2, 2}) return OverlapType::iii;
  return on_a == Counts{2, 2, 2} ? OverlapType::v : OverlapType::iv;
}

}  // namespace

int rational_orientation(const Vec2& a, const Vec2& b, const Vec2& c) {
  const auto point = [](const Vec2& v) { return RationalPoint{mpq_class(v[0]), mpq_class(v[1])}; };
  return sgn(turn(point(a), point(b), point(c)));
}

RationalOverlap rational_overlap(const Triangle& first, const Triangle& second) {
  Corners a = corners_of(first), b = corners_of(second);
  if (turn(b[0], b[1], b[2]) == 0) std::swap(a, b);
  RationalOverlap out;
  out.polygon.assign(a.begin(), a.end());
  for (std::size_t f = 0; f < 3; ++f) out.polygon = cut(out.polygon, b[f], b[(f + 1) % 3]);
  if (out.polygon.empty()) return out;
  for (std::size_t k = 1; k + 1 < out.polygon.size(); ++k)
    out.area += turn(out.polygon[0], out.polygon[k], out.polygon[k + 1]) / 2;
  out.type = out.area == 0 ? OverlapType::touch : type_with_area(a, b);
  return out;
}

}  // namespace isostat::oracle
