// The overlap of two triangles in lanes, one pair a lane, without branches: what the batch kernels of this room and the
// force kernels of later ones compile for each instruction set. V: base/lanes.hpp.
//
// Every edge of A is cut by the three half-planes of B, every edge of B by those of A; what is left of all edges bounds
// the overlap. With U the edge of A from p, w the edge of B from q, turn = w x U and c = w x (p - q):
//   on U the crossing of the lines is at t = -c/turn,                       entering B if turn > 0, else leaving
//   on w it is at s = ((p - q).w + t U.w)/|w|^2, the foot of the same point, entering A if turn < 0, else leaving
// (edge 2 of A is walked backwards, from corner 0: its signs change).
// Both decisions come from one sign and both places are one point, so where edges are parallel or coincide within
// rounding, t is arbitrary there and yet the boundary closes: the area's error is a few roundings of the extent squared
// for all pairs. (With s = (p - q) x U/turn, a rounding of its own, two coinciding edges may both count, or neither.)
// All of it is relative to corner 0 of A; area and moments are summed about a point inside the overlap, so that the
// terms of a small overlap are small.
#pragma once
#include "geometry/base/lanes.hpp"

namespace isostat::kernel {

// x[k], y[k]: corner k, anticlockwise, of positive area.
template <class V>
struct TriangleLanes {
  V x[3], y[3];
};

// The names of overlap_batch.hpp.
template <class V>
struct OverlapLanes {
  V area, gradient_x, gradient_y, rotation_a, rotation_b, chord;
  V point_x, point_y;  // mean of the boundary, inside the overlap; relative to corner 0 of A
};

template <class V>
ISOSTAT_INLINE V cross_lanes(V ax, V ay, V bx, V by) {
  return mul_add<V>(ax, by, -(ay * bx));
}
template <class V>
ISOSTAT_INLINE V dot_lanes(V ax, V ay, V bx, V by) {
  return mul_add<V>(ax, bx, ay * by);
}

// What the three half-planes of one side leave of an edge, in the edge's own coordinate.
template <class V>
struct IntervalLanes {
  V low, high;
  ISOSTAT_INLINE void cut(const typename V::mask_type& enters, const typename V::mask_type& leaves, V at) {
    low = select(enters, max(low, at), low);
    high = select(leaves, min(high, at), high);
  }
};

template <class V>
ISOSTAT_INLINE OverlapLanes<V> overlap_lanes(const TriangleLanes<V>& a, const TriangleLanes<V>& b) {
  const V zero(0.0), one(1.0), half(0.5), third(1.0 / 3);
  const V tiny(1e-200);  // in place of the turn of exactly parallel lines: they cross far away, on the side of c's sign

  // Corners relative to corner 0 of A, and edges; edge 2 of A from corner 0 to corner 2.
  const V p1x = a.x[1] - a.x[0], p1y = a.y[1] - a.y[0], p2x = a.x[2] - a.x[0], p2y = a.y[2] - a.y[0];
  const V ux[3] = {p1x, p2x - p1x, p2x}, uy[3] = {p1y, p2y - p1y, p2y};
  V qx[3], qy[3], wx[3], wy[3];
#pragma GCC unroll 3
  for (int f = 0; f < 3; ++f) qx[f] = b.x[f] - a.x[0], qy[f] = b.y[f] - a.y[0];
#pragma GCC unroll 3
  for (int f = 0; f < 3; ++f) wx[f] = qx[f == 2 ? 0 : f + 1] - qx[f], wy[f] = qy[f == 2 ? 0 : f + 1] - qy[f];

  IntervalLanes<V> on_a[3] = {{zero, one}, {zero, one}, {zero, one}};
  V weight(1e-300), mean_x = zero, mean_y = zero;  // of the portions: sums of length, and of length times midpoint
  V length_b[3];
#pragma GCC unroll 3
  for (int f = 0; f < 3; ++f) {
    // turn = w x U and U.w; -c and (p - q).w at the start of each edge of A.
    V turn[3], along[3], minus_c[3], foot[3];
    turn[0] = cross_lanes(wx[f], wy[f], ux[0], uy[0]), along[0] = dot_lanes(wx[f], wy[f], ux[0], uy[0]);
    turn[2] = cross_lanes(wx[f], wy[f], ux[2], uy[2]), along[2] = dot_lanes(wx[f], wy[f], ux[2], uy[2]);
    turn[1] = turn[2] - turn[0], along[1] = along[2] - along[0];
    minus_c[0] = minus_c[2] = cross_lanes(wx[f], wy[f], qx[f], qy[f]), minus_c[1] = minus_c[0] - turn[0];
    foot[0] = foot[2] = -dot_lanes(wx[f], wy[f], qx[f], qy[f]), foot[1] = foot[0] + along[0];
    const V square = dot_lanes(wx[f], wy[f], wx[f], wy[f]);
    IntervalLanes<V> on_b{zero, square};
#pragma GCC unroll 3
    for (int e = 0; e < 3; ++e) {
      const V safe = turn[e] + tiny;
      const V t = minus_c[e] / safe;
      const V s = mul_add<V>(t, along[e], foot[e]);
      const auto positive = safe > zero, negative = safe < zero;
      on_a[e].cut(positive, negative, t);
      if (e == 2)
        on_b.cut(positive, negative, s);
      else
        on_b.cut(negative, positive, s);
    }
    const V inverse_square = one / square;
    length_b[f] = max(on_b.high - on_b.low, zero) * inverse_square;
    const V middle = half * inverse_square * (on_b.low + on_b.high) * length_b[f];
    weight = weight + length_b[f];
    mean_x = mul_add<V>(middle, wx[f], mul_add<V>(length_b[f], qx[f], mean_x));
    mean_y = mul_add<V>(middle, wy[f], mul_add<V>(length_b[f], qy[f], mean_y));
  }
  V length_a[3], middle_a[3];
#pragma GCC unroll 3
  for (int e = 0; e < 3; ++e) {
    length_a[e] = max(on_a[e].high - on_a[e].low, zero);
    middle_a[e] = half * (on_a[e].low + on_a[e].high);
    const V middle = middle_a[e] * length_a[e];
    weight = weight + length_a[e];
    mean_x = mul_add<V>(middle, ux[e], mean_x), mean_y = mul_add<V>(middle, uy[e], mean_y);
  }
  mean_x = mul_add<V>(length_a[1], p1x, mean_x), mean_y = mul_add<V>(length_a[1], p1y, mean_y);
  const V inverse_weight = one / weight;
  const V mx = mean_x * inverse_weight, my = mean_y * inverse_weight;  // a point inside the overlap
  length_a[2] = -length_a[2];                                          // walked backwards

  V twice_area = zero, moment = zero, sum_x = zero, sum_y = zero;  // of A's portions
#pragma GCC unroll 3
  for (int f = 0; f < 3; ++f)
    twice_area = mul_add<V>(length_b[f], cross_lanes<V>(qx[f] - mx, qy[f] - my, wx[f], wy[f]), twice_area);
#pragma GCC unroll 3
  for (int e = 0; e < 3; ++e) {
    const V rx = e == 1 ? p1x - mx : -mx, ry = e == 1 ? p1y - my : -my;
    twice_area = mul_add<V>(length_a[e], cross_lanes<V>(rx, ry, ux[e], uy[e]), twice_area);
    const V to_x = mul_add<V>(middle_a[e], ux[e], rx), to_y = mul_add<V>(middle_a[e], uy[e], ry);
    moment = mul_add<V>(length_a[e], dot_lanes<V>(to_x, to_y, ux[e], uy[e]), moment);
    sum_x = mul_add<V>(length_a[e], ux[e], sum_x), sum_y = mul_add<V>(length_a[e], uy[e], sum_y);
  }
  // From the centroids to the mean.
  const V arm_ax = mul_add<V>(-third, p1x + p2x, mx), arm_ay = mul_add<V>(-third, p1y + p2y, my);
  const V arm_bx = mul_add<V>(-third, qx[0] + qx[1] + qx[2], mx),
          arm_by = mul_add<V>(-third, qy[0] + qy[1] + qy[2], my);
  return {max(half * twice_area, zero),
          sum_y,
          -sum_x,
          -(moment + dot_lanes(arm_ax, arm_ay, sum_x, sum_y)),
          moment + dot_lanes(arm_bx, arm_by, sum_x, sum_y),
          sqrt(dot_lanes(sum_x, sum_y, sum_x, sum_y)),
          mx,
          my};
}

}  // namespace isostat::kernel
