// Springs carried with their contact over one step, so that a rigid motion of two grains turns them and nothing else.
//
// The normal turns by the angle |q|: with e = dr/|r| the displacement of the branch vector in the step, q = e_T / (1 -
// e_n) and n_old = (n - q)/sqrt(1 + q^2). The turn that takes n_old to n takes a T normal to n_old to
//   T - (T.n) (n_old + n)/(1 + n_old.n) = T - (T.n) n + (T.n) q (1/2 - q^2/8 + ...),
// normal to n and of the same magnitude, to the sixth order of the angle (1e-3 a step is much). Then T turns about n by
// the mean spin of the grains, each weighted by its radius (equal spins count fully whatever the weights, and this mean
// is at hand), s = n.(R_i w_i + R_j w_j)/(R_i + R_j).
#pragma once
#include "dem/spheres/kernel/row.hpp"

namespace isostat::spheres {

template <class V>
struct ContactTurn {
  Real3<V> tilt;  // q
  V twist;        // s dt [rad]
};

// inverse = 1/|r|, receded = n.dr, slide = dr - n (n.dr) over the step.
template <class V>
ISOSTAT_INLINE ContactTurn<V> contact_turn(V inverse, V receded, const Real3<V>& slide, V twist) {
  const V scale = mul_add<V>(receded * inverse, inverse, inverse);  // 1/(1 - e_n) to second order
  return {{slide[0] * scale, slide[1] * scale, slide[2] * scale}, twist};
}

template <class V>
ISOSTAT_INLINE Real3<V> carried_tangential(const Real3<V>& t, const Real3<V>& n, const ContactTurn<V>& turn) {
  const V along = dot_3d<V>(t, n), tilt2 = dot_3d<V>(turn.tilt, turn.tilt);
  const V part = along * mul_add<V>(tilt2, V(-0.125), V(0.5));
  Real3<V> out;
  for (std::size_t k = 0; k < 3; ++k) out[k] = mul_add<V>(part, turn.tilt[k], mul_add<V>(-along, n[k], t[k]));
  const V a2 = turn.twist * turn.twist;
  const V sine = turn.twist * mul_add<V>(a2, V(-1.0 / 6), V(1.0));
  const V cosine = mul_add<V>(a2, mul_add<V>(a2, V(1.0 / 24), V(-0.5)), V(1.0));
  const Real3<V> across = cross_3d<V>(n, out);
  for (std::size_t k = 0; k < 3; ++k) out[k] = mul_add<V>(sine, across[k], cosine * out[k]);
  return out;
}

// A moment has a part along n, too. Both turns one after the other are one by  n x q + s dt (n - q/2), to the third
// order.
template <class V>
ISOSTAT_INLINE Real3<V> carried_moment(const Real3<V>& m, const Real3<V>& n, const ContactTurn<V>& turn) {
  Real3<V> angle = cross_3d<V>(n, turn.tilt);
  for (std::size_t k = 0; k < 3; ++k)
    angle[k] = mul_add<V>(turn.twist, mul_add<V>(V(-0.5), turn.tilt[k], n[k]), angle[k]);
  const V a2 = dot_3d<V>(angle, angle);
  const V sine = mul_add<V>(a2, V(-1.0 / 6), V(1.0)), versine = mul_add<V>(a2, V(-1.0 / 24), V(0.5));
  const Real3<V> once = cross_3d<V>(angle, m), twice = cross_3d<V>(angle, once);
  Real3<V> out;
  for (std::size_t k = 0; k < 3; ++k) out[k] = mul_add<V>(versine, twice[k], mul_add<V>(sine, once[k], m[k]));
  return out;
}

}  // namespace isostat::spheres
