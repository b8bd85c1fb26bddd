// The steps in which a contact forms or ends: forces act on a part of the step only.
//
// The leapfrog scheme works with forces at instants, i.e. by the trapezium rule over the steps between them. Where a
// contact begins or ends within a step the elastic forces have a kink and the viscous force a jump, which the rule
// misses: to first order in the step for the impulse of the jump, and for the work of the kink by K (v dt)^2 / 12 on
// average, which adds up over collisions (1e-3 of the energy of each at dt = .06 sqrt(m/K)). Weights on the forces of
// that one step make impulse and work right. With `part` the part of the step that the contact exists, and the ratio r
// of the displacement in the whole step after (before) it to that in this one:
//   kink, force from 0 to N:   work N (part + r)/2, rule N (1 + r)/2    weight (part + r)/(1 + r)
//   jump, force N throughout:  impulse N (part + 1/2), rule N           weight 1/2 + part
// A spring stretches by the displacement while the contact exists, `part` of the step's.
#pragma once
#include "dem/disks/disk_law.hpp"
#include "dem/disks/kernel/row.hpp"

namespace isostat::kernel {

template <class Real>
struct CrossingWeights {
  Real elastic = Real(1.0);  // of the forces of normal, tangential and rolling springs
  Real viscous = Real(1.0);  // of the viscous force
  Real stretch = Real(1.0);  // of the displacement of the tangential and rolling springs
};

// Whether any pair begins or ends its contact in this step or the next: gap h [a] now, receded [a] = dh over the step.
template <class Real>
ISOSTAT_INLINE bool crosses(Real gap, Real receded) {
  return any_of(max(gap, -gap) < max(receded, -receded));
}

// The next step is taken to repeat the displacement, but for the braking by the viscous force of a contact that forms:
// braking / damping = eta dt / m_r is the part of the velocity that this force takes in a step.
template <class Real>
ISOSTAT_INLINE CrossingWeights<Real> crossing_weights(Real gap, Real receded, double braking, Real damping) {
  CrossingWeights<Real> w;
  const Real zero(0.0), one(1.0), half(0.5), distance = max(gap, -gap), span = max(receded, -receded);
  const Real part = distance / span;
  const auto affected = distance < span, forming = receded < zero;
  const auto contact = affected && gap < zero, forms = contact && forming;
  const Real slowed = max(one - Real(braking) / damping * (half + part), zero), ratio = select(forms, slowed, one);
  w.elastic = select(contact, (part + ratio) / (one + ratio), one);
  w.viscous = select(contact, half + part, one);
  w.stretch = select(forms, part, select(affected && !contact && !forming, one - part, one));  // formed, or has ended
  return w;
}

// 4 zeta^2 K dt, as eta = 2 zeta sqrt(K m_r).
inline double crossing_braking(const DiskLaw& p, double time_step) {
  return 4 * p.damping * p.damping * p.normal_stiffness * time_step;
}

}  // namespace isostat::kernel
