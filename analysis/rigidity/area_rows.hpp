// Rows of G of an overlap of triangles: loads of a unit pressure, and of a unit friction force, on every triangle that
// the overlap clips. Rational in the corners, so that one formula serves doubles, prime fields and derivatives.
//
// The gradient of the area of A and B for a motion of A is the sum over the sides that lie on A of (side turned by -90
// degrees), and for its rotation of -(midpoint - centroid) . side. Pressure pushes the other way.
#pragma once
#include <array>
#include <vector>

#include "analysis/link_network.hpp"
#include "geometry/base/index.hpp"

namespace isostat {

template <class Real>
using PlanePoint = std::array<Real, 2>;

inline double quotient(double a, double b) { return a / b; }
template <class F>
auto quotient(const F& a, const F& b) -> decltype(b.inverse()) {
  return a * b.inverse();
}

// On the pair: force on j (opposite on i) and moments about the reference points of both.
template <class Real>
struct PairLoad {
  Real fx{}, fy{}, moment_i{}, moment_j{};
};

template <class Real>
struct PairArea {
  PairLoad<Real> twice;  // of unit pressure, times two
  Real twice_area{};
  PlanePoint<Real>
      point;  // where friction acts: midpoints of the sides, weighted by the parts of their edges that they are
};

// a, b: corners; at_a, at_b: the points that moments are about, in any case the centroids.
template <class Real>
PairArea<Real> pair_area(const OverlapBoundary& boundary, const std::array<PlanePoint<Real>, 3>& a,
                         const std::array<PlanePoint<Real>, 3>& b, const PlanePoint<Real>& at_a,
                         const PlanePoint<Real>& at_b) {
  const auto minus = [](const PlanePoint<Real>& p, const PlanePoint<Real>& q) {
    return PlanePoint<Real>{p[0] - q[0], p[1] - q[1]};
  };
  const auto cross = [](const PlanePoint<Real>& p, const PlanePoint<Real>& q) { return p[0] * q[1] - p[1] * q[0]; };
  const auto next = [](int k) { return idx(k == 2 ? 0 : k + 1); };
  std::array<PlanePoint<Real>, 6> vertex{};
  const auto count = idx(boundary.count);
  for (std::size_t k = 0; k < count; ++k) {
    const OverlapCorner& v = boundary.side[k].start;
    if (v.kind == CornerKind::corner_a) {
      vertex[k] = a[idx(v.a)];
    } else if (v.kind == CornerKind::corner_b) {
      vertex[k] = b[idx(v.b)];
    } else {
      const auto& start = a[idx(v.a)];
      const auto u = minus(a[next(v.a)], start), w = minus(b[next(v.b)], b[idx(v.b)]);
      const Real t = quotient(cross(minus(b[idx(v.b)], start), w), cross(u, w));
      vertex[k] = {start[0] + t * u[0], start[1] + t * u[1]};
    }
  }
  PairArea<Real> out;
  PlanePoint<Real> on_a{}, on_b{};  // sums of sides
  Real twice_parts{};
  for (std::size_t k = 0; k < count; ++k) {
    const auto &p = vertex[k], &q = vertex[k + 1 == count ? 0 : k + 1];
    const auto side = minus(q, p);
    const bool of_a = boundary.side[k].owner == Owner::a;
    const auto &at = of_a ? at_a : at_b, &from = vertex[0];
    const auto arm_p = minus(p, at), arm_q = minus(q, at);
    auto& sum = of_a ? on_a : on_b;
    sum = {sum[0] + side[0], sum[1] + side[1]};
    Real& moment = of_a ? out.twice.moment_i : out.twice.moment_j;
    moment = moment + (arm_p[0] + arm_q[0]) * side[0] + (arm_p[1] + arm_q[1]) * side[1];
    out.twice_area = out.twice_area + cross(minus(p, from), minus(q, from));
    const auto& of = of_a ? a : b;
    const auto edge = minus(of[next(boundary.side[k].edge)], of[idx(boundary.side[k].edge)]);
    const Real part = quotient(side[0] * edge[0] + side[1] * edge[1], edge[0] * edge[0] + edge[1] * edge[1]);
    twice_parts = twice_parts + part + part;
    out.point = {out.point[0] + part * (p[0] + q[0]), out.point[1] + part * (p[1] + q[1])};
  }
  for (Real& x : out.point) x = quotient(x, twice_parts);
  // On B (-y, x) of its sides; they close the polygon with those of A.
  out.twice.fx = on_a[1] + on_a[1], out.twice.fy = -(on_a[0] + on_a[0]);
  return out;
}

// What a row asks of one triangle, in the image that the overlap meets.
template <class Real>
struct TriangleLoad {
  std::int32_t body = 0;
  ImageShift<2> shift{};     // of the body
  std::array<Real, 3> at{};  // force and moment about the reference point
};

// Loads of a row: of a unit pressure times two (normal), or of a friction force along z x the total force of the
// pressure (tangential) at the mean point of the overlap, shared by the pairs in proportion to their areas, times a
// positive factor (dem/triangles/overlap_search.cpp). measure: from an AreaPair to its PairArea; reference: from a body
// and its image to the point of its moments.
template <class Real, class Measure, class Reference>
std::vector<TriangleLoad<Real>> area_loads(const AreaLink& link, bool tangential, Measure&& measure,
                                           Reference&& reference) {
  std::vector<TriangleLoad<Real>> loads;
  const auto add = [&](std::int32_t body, const ImageShift<2>& shift, const std::array<Real, 3>& at) {
    for (TriangleLoad<Real>& l : loads)
      if (l.body == body && l.shift == shift) {
        for (std::size_t d = 0; d < 3; ++d) l.at[d] = l.at[d] + at[d];
        return;
      }
    loads.push_back({body, shift, at});
  };
  std::vector<PairArea<Real>> pairs;
  Real fx{}, fy{};
  for (const AreaPair& pair : link.pairs) {
    pairs.push_back(measure(pair));
    const PairLoad<Real>& load = pairs.back().twice;
    fx = fx + load.fx, fy = fy + load.fy;
    if (tangential) continue;
    add(pair.i, {}, {-load.fx, -load.fy, load.moment_i});
    add(pair.j, pair.shift, {load.fx, load.fy, load.moment_j});
  }
  if (!tangential) return loads;
  PlanePoint<Real> point{};
  Real area{};
  for (const PairArea<Real>& p : pairs) {
    area = area + p.twice_area;
    point = {point[0] + p.twice_area * p.point[0], point[1] + p.twice_area * p.point[1]};
  }
  for (Real& x : point) x = quotient(x, area);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const AreaPair& pair = link.pairs[k];
    const Real tx = -(fy * pairs[k].twice_area), ty = fx * pairs[k].twice_area;
    const auto moment = [&](const PlanePoint<Real>& about) {
      return (point[0] - about[0]) * ty - (point[1] - about[1]) * tx;
    };
    add(pair.i, {}, {-tx, -ty, -moment(reference(pair.i, ImageShift<2>{}))});
    add(pair.j, pair.shift, {tx, ty, moment(reference(pair.j, pair.shift))});
  }
  return loads;
}

// In doubles, faithful (geometry/triangle_overlap.hpp): of unit pressure [cm] and unit friction force, moments about
// the centroids.
std::vector<TriangleLoad<double>> area_loads(const LinkNetwork& network, const AreaLink& link, bool tangential);

}  // namespace isostat
