// Forces and dampers of beams, eight grains of one topology at a time, and the total load of every triangle. Included
// by kernels_*.cpp only. The formulas are those of dem/state/beam.hpp.
//
// Dampers see velocities at the full step. Those are predicted from the half step before and the load before; of spins,
// which the dampers of small grains would make unstable first, the mean over the step is taken in their place: the
// torque of the dampers on a triangle is -D w with D the sum of gamma I/L0 over its beams (no other spin enters it), so
//   w = (w(n-1/2) + (dt/2J) (torque + D w_p)) / (1 + (dt/2J) D),   torque with the predicted spin w_p
// and with the same spins in the shear forces (force c_T L/2 times the change of both spins) the dampers' forces and
// moments balance, which keeps angular momentum to rounding.
#pragma once
#include <cmath>

#include "dem/triangles/kernel/rows.hpp"
#include "dem/triangles/kernel/triangle_kernels.hpp"

namespace isostat::kernel {

// atan2(sine, cosine) of a rotation |T|: the series of the arc sine below kSmallTurn, to an ulp; the library beyond.
inline constexpr double kSmallTurn = 0.15;  // [rad]
template <class V>
ISOSTAT_INLINE V small_turn(V s) {
  const V z = s * s;
  V p(135135.0 / 9676800);
  p = mul_add<V>(p, z, V(10395.0 / 599040)), p = mul_add<V>(p, z, V(945.0 / 42240));
  p = mul_add<V>(p, z, V(105.0 / 3456)), p = mul_add<V>(p, z, V(15.0 / 336));
  p = mul_add<V>(p, z, V(3.0 / 40)), p = mul_add<V>(p, z, V(1.0 / 6));
  return mul_add<V>(p * z, s, s);
}
template <class V>
ISOSTAT_INLINE V turn_of(V sine, V cosine) {
  const V small(kSmallTurn), series = small_turn(sine);
  if (!any_of(max(sine, -sine) > small || cosine < V(0.0))) return series;
  // Lane by lane: what one grain feels does not depend on its neighbours in the block.
  constexpr std::size_t width = V::size();
  double s[width], c[width], turn[width];
  sine.copy_to(s, stdx::element_aligned), cosine.copy_to(c, stdx::element_aligned);
  series.copy_to(turn, stdx::element_aligned);
  for (std::size_t w = 0; w < width; ++w)
    if (std::abs(s[w]) > kSmallTurn || c[w] < 0) turn[w] = std::atan2(s[w], c[w]);
  return V(turn, stdx::element_aligned);
}

template <class V, bool kDamping, bool kVirial>
ISOSTAT_INLINE BeamTally beam_forces_in(const BeamInput& in) {
  constexpr std::size_t width = V::size();
  const GrainArrays& g = in.arrays;
  const V half(0.5), one(1.0), six(6.0), h(in.half_step);
  V virial_x(0.0), virial_y(0.0);
  const auto at = [](const double* p) { return V(p, stdx::element_aligned); };
  const auto put = [](double* p, V v) { v.copy_to(p, stdx::element_aligned); };
  const auto add = [&](double* p, V v) { put(p, at(p) + v); };
  for (std::size_t n = in.begin; n < in.end; ++n) {
    const GrainBlock& block = in.blocks[n];
    const std::size_t triangles = block.triangles;
    double *fx = in.work, *fy = fx + kLanes * triangles, *torque = fy + kLanes * triangles,
           *viscous = torque + kLanes * triangles, *shear_x = viscous + kLanes * triangles,
           *shear_y = shear_x + kLanes * std::size_t{block.beams};
    for (std::size_t k = 0; k < kLanes * triangles; ++k) {
      double* load = g.loads + kLoadRow * (block.begin + k);
      fx[k] = load[0], fy[k] = load[1], torque[k] = load[2], viscous[k] = 0;
      load[0] = load[1] = load[2] = load[3] = 0;
    }
    for (std::size_t lane = 0; lane < kLanes; lane += width) {
      for (std::size_t b = 0; b < block.beams; ++b) {
        const std::size_t i = kLanes * block.joined[b][0] + lane, j = kLanes * block.joined[b][1] + lane;
        const std::size_t si = block.begin + i, sj = block.begin + j, c = block.beam_begin + kLanes * b + lane;
        const V rx = at(g.x + sj) - at(g.x + si), ry = at(g.y + sj) - at(g.y + si);
        const V length = sqrt(mul_add<V>(rx, rx, ry * ry)), inverse = one / length;
        const V nx = rx * inverse, ny = ry * inverse;
        const auto end = [&](std::size_t slot, const double* dx, const double* dy) {
          const V cosine = at(g.cosine + slot), sine = at(g.sine + slot), x = at(dx + c), y = at(dy + c);
          const V ex = mul_add<V>(cosine, x, -(sine * y)), ey = mul_add<V>(sine, x, cosine * y);
          return turn_of<V>(mul_add<V>(nx, ey, -(ny * ex)), mul_add<V>(nx, ex, ny * ey));
        };
        const V turn_i = end(si, g.xi, g.yi), turn_j = end(sj, g.xj, g.yj);
        const V bending = at(g.bending + c);
        V normal = at(g.stretching + c) * (at(g.length + c) - length);
        V tangential = six * bending * (turn_i + turn_j) * inverse;
        V moment = bending * (turn_i - turn_j);
        if constexpr (kDamping) {
          const V damping = at(g.bending_damping + c), wi = at(g.pw + si), wj = at(g.pw + sj);
          const V vx = mul_add<V>(V(in.flow[0]), rx, at(g.px + sj) - at(g.px + si));
          const V vy = mul_add<V>(V(in.flow[1]), ry, at(g.py + sj) - at(g.py + si));
          const V receding = mul_add<V>(nx, vx, ny * vy), across = mul_add<V>(nx, vy, -(ny * vx));
          normal = mul_add<V>(-at(g.damping + c), receding, normal);
          const V twice = V(2.0) * damping * inverse;  // c_T L = 2 (gamma I/L0) / L
          tangential = mul_add<V>(-(twice * inverse), mul_add<V>(-(half * length), wi + wj, across), tangential);
          moment = mul_add<V>(half * damping, wi - wj, moment);
          add(viscous + i, damping), add(viscous + j, damping);
          put(shear_x + kLanes * b + lane, -(half * twice * ny)), put(shear_y + kLanes * b + lane, half * twice * nx);
        }
        const V forward_x = mul_add<V>(normal, nx, -(tangential * ny));  // on j
        const V forward_y = mul_add<V>(normal, ny, tangential * nx);
        const V lever = half * tangential * length;
        add(fx + i, -forward_x), add(fy + i, -forward_y), add(torque + i, -lever - moment);
        add(fx + j, forward_x), add(fy + j, forward_y), add(torque + j, moment - lever);
        if constexpr (kVirial)
          virial_x = mul_add<V>(forward_x, rx, virial_x), virial_y = mul_add<V>(forward_y, ry, virial_y);
      }
      if constexpr (kDamping) {
        for (std::size_t t = 0; t < triangles; ++t) {
          const std::size_t k = kLanes * t + lane, slot = block.begin + k;
          const V d = at(viscous + k), rate = h * at(g.inverse_inertia + slot), predicted = at(g.pw + slot);
          const V spin =
              mul_add<V>(rate, mul_add<V>(d, predicted, at(torque + k)), at(g.uw + slot)) / mul_add<V>(rate, d, one);
          // Without a step (the first forces of a run) the predicted spin is the spin.
          const V change = in.half_step > 0 ? spin - predicted : V(0.0);
          put(torque + k, mul_add<V>(-d, change, at(torque + k)));
          put(viscous + k, change);
        }
        for (std::size_t b = 0; b < block.beams; ++b) {
          const std::size_t i = kLanes * block.joined[b][0] + lane, j = kLanes * block.joined[b][1] + lane;
          const V change = at(viscous + i) + at(viscous + j);
          const V sx = change * at(shear_x + kLanes * b + lane), sy = change * at(shear_y + kLanes * b + lane);
          add(fx + i, -sx), add(fy + i, -sy), add(fx + j, sx), add(fy + j, sy);
        }
      }
      for (std::size_t t = 0; t < triangles; ++t) {
        const std::size_t k = kLanes * t + lane, slot = block.begin + k;
        put(g.fx + slot, at(fx + k)), put(g.fy + slot, at(fy + k)), put(g.torque + slot, at(torque + k));
      }
    }
  }
  return {{reduce(virial_x), reduce(virial_y)}};
}

}  // namespace isostat::kernel
