// Motion of triangles, their corners, and the separation of near pairs, in lanes. Included by kernels_*.cpp only.
#pragma once
#include "dem/triangles/kernel/rows.hpp"
#include "dem/triangles/kernel/triangle_kernels.hpp"
#include "dem/triangles/kernel/turn.hpp"

namespace isostat::kernel {

template <class V>
ISOSTAT_INLINE void corners_in(std::size_t slot, const GrainArrays& g) {
  constexpr std::size_t width = V::size();
  const auto at = [](const double* p) { return V(p, stdx::element_aligned); };
  const TurnLanes<V> turn = turn_lanes(at(g.angle + slot));
  turn.cosine.copy_to(g.cosine + slot, stdx::element_aligned), turn.sine.copy_to(g.sine + slot, stdx::element_aligned);
  const V x = at(g.x + slot), y = at(g.y + slot);
  double corner[6][width];
  for (int k = 0; k < 3; ++k) {
    const V cx = at(g.corner[2 * k] + slot), cy = at(g.corner[2 * k + 1] + slot);
    mul_add<V>(turn.cosine, cx, mul_add<V>(-turn.sine, cy, x)).copy_to(corner[2 * k], stdx::element_aligned);
    mul_add<V>(turn.sine, cx, mul_add<V>(turn.cosine, cy, y)).copy_to(corner[2 * k + 1], stdx::element_aligned);
  }
  for (std::size_t w = 0; w < width; ++w) {
    double* row = g.rows + kCornerRow * (slot + w);
    for (int k = 0; k < 6; ++k) row[k] = corner[k][w];
  }
}

template <class V>
ISOSTAT_INLINE void all_corners_in(std::size_t begin, std::size_t end, const GrainArrays& g) {
  for (std::size_t slot = begin; slot < end; slot += V::size()) corners_in<V>(slot, g);
}

template <class V, bool kKinetic>
ISOSTAT_INLINE DriftTally drift_in(const DriftInput& in) {
  const GrainArrays& g = in.arrays;
  const V dt(in.time_step), half = V(0.5) * dt, weight(in.weight);
  const V keep_x(in.keep[0]), keep_y(in.keep[1]), keep_w(in.keep_spin);
  const V scale_x(in.scale[0]), scale_y(in.scale[1]), drift_x(in.drift[0]), drift_y(in.drift[1]);
  const auto at = [](const double* p) { return V(p, stdx::element_aligned); };
  const auto put = [](double* p, V v) { v.copy_to(p, stdx::element_aligned); };
  V speed(0.0), surface(0.0), kinetic_x(0.0), kinetic_y(0.0);
  for (std::size_t slot = in.begin; slot < in.end; slot += V::size()) {
    const V inverse_mass = at(g.inverse_mass + slot);
    const V ax = at(g.fx + slot) * inverse_mass;
    const V ay = mul_add<V>(at(g.fy + slot), inverse_mass, -(weight * at(g.heavy + slot)));
    const V aw = at(g.torque + slot) * at(g.inverse_inertia + slot);
    const V ux = mul_add<V>(dt, ax, at(g.ux + slot)) * keep_x, uy = mul_add<V>(dt, ay, at(g.uy + slot)) * keep_y;
    const V uw = mul_add<V>(dt, aw, at(g.uw + slot)) * keep_w;
    const V px = mul_add<V>(half, ax, ux), py = mul_add<V>(half, ay, uy);
    put(g.ux + slot, ux), put(g.uy + slot, uy), put(g.uw + slot, uw);
    put(g.px + slot, px), put(g.py + slot, py), put(g.pw + slot, mul_add<V>(half, aw, uw));
    if constexpr (kKinetic) {
      put(g.x + slot, mul_add<V>(drift_x, ux, at(g.x + slot) * scale_x));
      put(g.y + slot, mul_add<V>(drift_y, uy, at(g.y + slot) * scale_y));
      const V mass = at(g.mass + slot);
      kinetic_x = mul_add<V>(mass, px * px, kinetic_x), kinetic_y = mul_add<V>(mass, py * py, kinetic_y);
    } else {
      put(g.x + slot, mul_add<V>(dt, ux, at(g.x + slot)));
      put(g.y + slot, mul_add<V>(dt, uy, at(g.y + slot)));
    }
    put(g.angle + slot, mul_add<V>(dt, uw, at(g.angle + slot)));
    speed = max(speed, mul_add<V>(ux, ux, uy * uy));
    surface = max(surface, at(g.reach + slot) * max(uw, -uw));
    corners_in<V>(slot, g);
  }
  DriftTally tally;
  constexpr std::size_t width = V::size();
  double s[width], r[width];
  speed.copy_to(s, stdx::element_aligned), surface.copy_to(r, stdx::element_aligned);
  for (std::size_t w = 0; w < width; ++w) {
    tally.speed_squared = s[w] > tally.speed_squared || s[w] != s[w] ? s[w] : tally.speed_squared;
    tally.surface_speed = r[w] > tally.surface_speed || r[w] != r[w] ? r[w] : tally.surface_speed;
  }
  if constexpr (kKinetic) tally.kinetic[0] = reduce(kinetic_x), tally.kinetic[1] = reduce(kinetic_y);
  return tally;
}

// Whether the corners of a triangle are all further than `skin` outside an edge (x, y) -> (x + ux, y + uy) of the
// other, walked anticlockwise.
template <class V>
ISOSTAT_INLINE typename V::mask_type apart(V x, V y, V ux, V uy, const TriangleLanes<V>& t, V skin_squared) {
  V least = cross_lanes(t.x[0] - x, t.y[0] - y, ux, uy);
  for (int k = 1; k < 3; ++k) least = min(least, cross_lanes(t.x[k] - x, t.y[k] - y, ux, uy));
  return least > V(0.0) && least * least > skin_squared * dot_lanes(ux, uy, ux, uy);
}

template <class V>
ISOSTAT_INLINE void separations_in(const SeparationInput& in) {
  constexpr std::size_t width = V::size();
  const V zero(0.0), skin_squared(in.skin * in.skin);
  for (std::size_t n = 0; n < in.count; n += width) {
    const TriangleLanes<V> a = load_triangles(in.rows, in.a + n, V());
    TriangleLanes<V> b = load_triangles(in.rows, in.b + n, V());
    const V ox(in.offset_x + n, stdx::element_aligned), oy(in.offset_y + n, stdx::element_aligned);
    for (int k = 0; k < 3; ++k) b.x[k] = b.x[k] + ox, b.y[k] = b.y[k] + oy;
    V near(1.0);
    for (int e = 0; e < 3; ++e) {
      const int f = e == 2 ? 0 : e + 1;
      near = select(apart<V>(a.x[e], a.y[e], a.x[f] - a.x[e], a.y[f] - a.y[e], b, skin_squared), zero, near);
      near = select(apart<V>(b.x[e], b.y[e], b.x[f] - b.x[e], b.y[f] - b.y[e], a, skin_squared), zero, near);
    }
    double flag[width];
    near.copy_to(flag, stdx::element_aligned);
    for (std::size_t w = 0; w < width; ++w) in.near[n + w] = flag[w] > 0;
  }
}

}  // namespace isostat::kernel
