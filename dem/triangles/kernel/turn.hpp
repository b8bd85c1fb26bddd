// Sine and cosine in lanes, the same operations for every instruction set. Argument reduced by pi/2 in three parts
// (each product exact for |x| below 1e6), then the minimax polynomials of fdlibm (k_sin.c, k_cos.c): within an ulp or
// so.
#pragma once
#include "geometry/base/lanes.hpp"

namespace isostat::kernel {

template <class V>
struct TurnLanes {
  V cosine, sine;
};

template <class V>
ISOSTAT_INLINE TurnLanes<V> turn_lanes(V angle) {
  const V magic(6755399441055744.0);  // 1.5 2^52: adding and subtracting it rounds to the nearest integer
  const V quarters = mul_add<V>(angle, V(0.63661977236758134308), magic) - magic;
  V r = mul_add<V>(quarters, V(-1.57079632673412561417), angle);
  r = mul_add<V>(quarters, V(-6.07710050630396597660e-11), r);
  r = mul_add<V>(quarters, V(-2.02226624879595063154e-21), r);
  const V q = quarters - V(4.0) * (mul_add<V>(quarters, V(0.25), magic) - magic);  // -2 .. 2
  const V z = r * r;
  V s = V(1.58969099521155010221e-10);
  s = mul_add<V>(s, z, V(-2.50507602534068634195e-08)), s = mul_add<V>(s, z, V(2.75573137070700676789e-06));
  s = mul_add<V>(s, z, V(-1.98412698298579493134e-04)), s = mul_add<V>(s, z, V(8.33333333332248946124e-03));
  s = mul_add<V>(s, z, V(-1.66666666666666324348e-01));
  const V sine = mul_add<V>(s * z, r, r);
  V c = V(-1.13596475577881948265e-11);
  c = mul_add<V>(c, z, V(2.08757232129817482790e-09)), c = mul_add<V>(c, z, V(-2.75573143513906633035e-07));
  c = mul_add<V>(c, z, V(2.48015872894767294178e-05)), c = mul_add<V>(c, z, V(-1.38888888888741095749e-03));
  c = mul_add<V>(c, z, V(4.16666666666666019037e-02));
  const V half = V(0.5) * z, cosine = V(1.0) - (half - z * (z * c));
  const V square = q * q;  // 0, 1 or 4
  const auto odd = square > V(0.5) && square < V(2.0);
  const V a = select(odd, sine, cosine), b = select(odd, cosine, sine);  // |cos|, |sin| of the quadrant
  // q = 0: (c, s); 1: (-s, c); -1: (s, -c); +-2: (-c, -s)
  const auto half_turn = square > V(2.0);
  const auto negative_cosine = half_turn || q > V(0.5), negative_sine = half_turn || q < V(-0.5);
  return {select(negative_cosine, -a, a), select(negative_sine, -b, b)};
}

}  // namespace isostat::kernel
