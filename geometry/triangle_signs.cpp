#include "geometry/triangle_signs.hpp"

#include <algorithm>

#include "geometry/base/index.hpp"
#include "geometry/orientation.hpp"

namespace isostat {
namespace {

using Signs = std::array<std::array<std::int8_t, 3>, 3>;
constexpr int next(int k) { return TriangleSigns::next(k); }

// Closed segments pq and rs, points included.
bool segments_meet(const Vec2& p, const Vec2& q, const Vec2& r, const Vec2& s) {
  const int pqr = orientation_sign(p, q, r), pqs = orientation_sign(p, q, s);
  const int rsp = orientation_sign(r, s, p), rsq = orientation_sign(r, s, q);
  if (pqr * pqs > 0 || rsp * rsq > 0) return false;
  if (pqr != 0 || pqs != 0 || rsp != 0 || rsq != 0) return true;
  for (int k = 0; k < 2; ++k)  // on one line
    if (std::max(p[k], q[k]) < std::min(r[k], s[k]) || std::max(r[k], s[k]) < std::min(p[k], q[k])) return false;
  return true;
}

bool holds(const Triangle& t, const Vec2& p) {  // t anticlockwise
  for (int k = 0; k < 3; ++k)
    if (orientation_sign(t.corner[idx(k)], t.corner[idx(next(k))], p) < 0) return false;
  return true;
}

// Closed sets of which at least one is a segment or a point.
bool flat_sets_meet(const Triangle& a, bool flat_a, const Triangle& b, bool flat_b) {
  for (int e = 0; e < 3; ++e)
    for (int f = 0; f < 3; ++f)
      if (segments_meet(a.corner[idx(e)], a.corner[idx(next(e))], b.corner[idx(f)], b.corner[idx(next(f))]))
        return true;
  return (!flat_a && holds(a, b.corner[0])) || (!flat_b && holds(b, a.corner[0]));
}

// Where the corners of p lie to the edge k of q. Returns the largest sign: negative if the edge's line separates.
int against_edge(const Triangle& p, const Triangle& q, int k, Signs& of_p) {
  int most = -1;
  for (int i = 0; i < 3; ++i) {
    const int s = orientation_sign(q.corner[idx(k)], q.corner[idx(next(k))], p.corner[idx(i)]);
    of_p[idx(i)][idx(k)] = static_cast<std::int8_t>(s);
    most = std::max(most, s);
  }
  return most;
}

OverlapType type_by_crossings(const TriangleSigns& s) {
  std::array<int, 3> on_a{}, on_b{};
  int all = 0;
  for (int e = 0; e < 3; ++e)
    for (int f = 0; f < 3; ++f)
      if (s.cross(e, f)) ++on_a[idx(e)], ++on_b[idx(f)], ++all;
  const auto has = [](const std::array<int, 3>& on, int n) { return std::find(on.begin(), on.end(), n) != on.end(); };
  if (all == 0) return OverlapType::degenerate;
  if (all == 2) return has(on_a, 2) || has(on_b, 2) ? OverlapType::i : OverlapType::ii;
  if (all == 4) return has(on_a, 0) && has(on_b, 0) ? OverlapType::iii : OverlapType::iv;
  return OverlapType::v;
}

OverlapType find_type(TriangleSigns& s, bool flat_a, bool flat_b) {
  if (flat_a || flat_b) return flat_sets_meet(s.a, flat_a, s.b, flat_b) ? OverlapType::touch : OverlapType::separate;
  int least = 1;  // convex sets have no common point, or no common area, if and only if an edge of one separates them
  for (int k = 0; k < 3; ++k) {
    least = std::min({least, against_edge(s.a, s.b, k, s.of_a), against_edge(s.b, s.a, k, s.of_b)});
    if (least < 0) return OverlapType::separate;
  }
  if (least == 0) return OverlapType::touch;
  const auto on_a_line = [](const auto& row) { return std::find(row.begin(), row.end(), 0) != row.end(); };
  if (std::any_of(s.of_a.begin(), s.of_a.end(), on_a_line) || std::any_of(s.of_b.begin(), s.of_b.end(), on_a_line))
    return OverlapType::degenerate;
  return type_by_crossings(s);
}

// Returns whether the triangle has no area.
bool turn_anticlockwise(Triangle& t, bool& turned) {
  const int turn = orientation_sign(t.corner[0], t.corner[1], t.corner[2]);
  turned = turn < 0;
  if (turned) std::swap(t.corner[1], t.corner[2]);
  return turn == 0;
}

}  // namespace

std::string_view name(OverlapType type) {
  constexpr std::string_view names[] = {"separate", "touch", "degenerate", "i", "ii", "iii", "iv", "v"};
  return names[static_cast<int>(type)];
}

bool TriangleSigns::cross(int e, int f) const {
  return of_a[idx(e)][idx(f)] * of_a[idx(next(e))][idx(f)] < 0 && of_b[idx(f)][idx(e)] * of_b[idx(next(f))][idx(e)] < 0;
}

TriangleSigns triangle_signs(const Triangle& a, const Triangle& b) {
  TriangleSigns s{.a = a, .b = b, .of_a = {}, .of_b = {}};
  const bool flat_a = turn_anticlockwise(s.a, s.a_turned), flat_b = turn_anticlockwise(s.b, s.b_turned);
  s.type = find_type(s, flat_a, flat_b);
  return s;
}

OverlapType overlap_type(const Triangle& a, const Triangle& b) { return triangle_signs(a, b).type; }

}  // namespace isostat
