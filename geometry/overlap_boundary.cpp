#include "geometry/overlap_boundary.hpp"

#include <algorithm>

#include "geometry/base/index.hpp"

namespace isostat {
namespace {

constexpr int next(int k) { return TriangleSigns::next(k); }
constexpr int before(int k) { return k == 0 ? 2 : k - 1; }

// Degenerate pairs become generic by moving the edges of B outwards, edge 0 by more than edge 1, edge 1 by more than
// edge 2, all by less than any number. Then corners of A on an edge's line are inside it. A corner of B on a line of A
// moves with its two edges; the one that moves more decides: corner j goes along edge j - 1 when edge j moves, away
// from corner j - 1. Directions stay, so parallel edges never cross.
void perturb(TriangleSigns& s) {
  for (auto& corner : s.of_a)
    for (std::int8_t& sign : corner) sign = sign == 0 ? 1 : sign;
  const auto given = s.of_b;
  for (int j = 0; j < 3; ++j)
    for (int e = 0; e < 3; ++e) {
      if (given[idx(j)][idx(e)] != 0) continue;
      const std::int8_t by_own = given[idx(before(j))][idx(e)], by_last = given[idx(next(j))][idx(e)];
      const bool own_first = j < before(j);
      const std::int8_t first = own_first ? by_own : by_last, second = own_first ? by_last : by_own;
      s.of_b[idx(j)][idx(e)] = static_cast<std::int8_t>(first != 0 ? -first : -second);
    }
}

// The part of one edge inside the other triangle, after perturb(): from its corner or where it enters, to the next
// corner or where it leaves. Edge numbers of the crossings, -1: none.
struct Portion {
  int enters = -1, leaves = -1;
  bool starts_inside = false;
  bool exists() const { return starts_inside || enters >= 0; }
};
Portion portion(const TriangleSigns& s, Owner owner, int edge) {
  const auto& of = owner == Owner::a ? s.of_a : s.of_b;
  const auto& first = of[idx(edge)];
  Portion p;
  p.starts_inside = *std::min_element(first.begin(), first.end()) > 0;
  for (int k = 0; k < 3; ++k)
    if (owner == Owner::a ? s.cross(edge, k) : s.cross(k, edge)) (first[idx(k)] < 0 ? p.enters : p.leaves) = k;
  return p;
}

OverlapCorner crossing(Owner owner, int edge, int other) {
  return owner == Owner::a ? OverlapCorner{CornerKind::crossing, edge, other}
                           : OverlapCorner{CornerKind::crossing, other, edge};
}

// Around the overlap of a perturbed pair with common area.
OverlapBoundary trace(const TriangleSigns& s) {
  Owner owner = Owner::a;
  int edge = -1;
  for (int e = 0; e < 3 && edge < 0; ++e)
    if (portion(s, Owner::a, e).enters >= 0) edge = e;
  if (edge < 0) edge = 0, owner = portion(s, Owner::a, 0).exists() ? Owner::a : Owner::b;  // one inside the other
  OverlapBoundary boundary;
  const Owner first_owner = owner;
  const int first_edge = edge;
  do {
    const Portion p = portion(s, owner, edge);
    const auto corner = owner == Owner::a ? CornerKind::corner_a : CornerKind::corner_b;
    const OverlapCorner start = p.enters >= 0 ? crossing(owner, edge, p.enters) : OverlapCorner{corner, edge, edge};
    boundary.side[idx(boundary.count++)] = {owner, edge, start};
    if (p.leaves >= 0)
      owner = owner == Owner::a ? Owner::b : Owner::a, edge = p.leaves;
    else
      edge = next(edge);
  } while ((owner != first_owner || edge != first_edge) && boundary.count < 6);
  return boundary;
}

// One name for each point: a crossing at a corner is that corner, a corner of both is A's.
OverlapCorner canonical(const TriangleSigns& s, OverlapCorner v) {
  if (v.kind == CornerKind::crossing) {
    const int e = v.a, f = v.b;
    if (s.of_a[idx(e)][idx(f)] == 0) return {CornerKind::corner_a, e, e};
    if (s.of_a[idx(next(e))][idx(f)] == 0) return {CornerKind::corner_a, next(e), next(e)};
    if (s.of_b[idx(f)][idx(e)] == 0) v = {CornerKind::corner_b, f, f};
    if (s.of_b[idx(next(f))][idx(e)] == 0) v = {CornerKind::corner_b, next(f), next(f)};
  }
  if (v.kind == CornerKind::corner_b)
    for (int i = 0; i < 3; ++i)
      if (s.a.corner[idx(i)] == s.b.corner[idx(v.b)]) return {CornerKind::corner_a, i, i};
  return v;
}

}  // namespace

OverlapBoundary overlap_boundary(const TriangleSigns& signs) {
  if (signs.type != OverlapType::degenerate) return trace(signs);
  TriangleSigns generic = signs;
  perturb(generic);
  const OverlapBoundary all = trace(generic);
  std::array<OverlapCorner, 6> vertex;
  for (int k = 0; k < all.count; ++k) vertex[idx(k)] = canonical(signs, all.side[idx(k)].start);
  OverlapBoundary kept;
  for (int k = 0; k < all.count; ++k)
    if (vertex[idx(k)] != vertex[idx(k + 1 == all.count ? 0 : k + 1)])
      kept.side[idx(kept.count++)] = {all.side[idx(k)].owner, all.side[idx(k)].edge, vertex[idx(k)]};
  return kept;
}

}  // namespace isostat
