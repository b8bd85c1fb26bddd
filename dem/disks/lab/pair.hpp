// `lab pair`: two disks of diameter a against closed forms.
#pragma once
#include <vector>

#include "dem/scene/scene.hpp"

namespace isostat::lab {

// Head-on collision at a relative speed, for several sub-step phases of the first contact. Closed form without
// cohesion: e = exp(-pi zeta / sqrt(1 - zeta^2)) (Gilabert 2007, Sec. II.C).
struct Restitution {
  double step_fraction = 0;
  double mean = 0;    // over the phases
  double spread = 0;  // largest minus smallest
  double exact = 0;
};
Restitution restitution(const LawScene& law, double step_fraction, double speed, int phases);

// Smallest receding speed at which two disks that touch at h = 0 separate, by bisection; closed form sqrt(2) V* with
// V* = sqrt(F0 D0 / m) (Gilabert 2007, Eq. 7). The disks recede along the normal.
struct PullOff {
  double speed = 0, exact = 0;  // [a/T0]
  double largest_tension = 0;   // [F0] -min N of the static law: F0
};
PullOff pull_off(const LawScene& law, double step_fraction);

// A disk grazes another: normal and tangential approach speeds, no spins, no cohesion. While the contact slides all
// along, the tangential impulse is mu times the elastic part of the normal one, mu m_r (1 + e) v_n (the dashpot's
// impulse is zero over a collision, which begins and ends at h = 0).
struct ObliqueImpact {
  double normal_velocity = 0, tangential_velocity = 0, spin = 0;  // of disk 1 after, averaged over the phases
  double spread = 0;                                              // of the tangential velocity
  double sliding_exact = 0;  // tangential velocity of disk 1 if it slides throughout
};
ObliqueImpact oblique_impact(const LawScene& law, double step_fraction, double normal_speed, double tangential_speed,
                             int phases);

// The force law under prescribed motion: N(h) for a slow pass through contact and attraction; T(u) for a tangential
// cycle at constant h, and M(theta) for a rolling cycle. Forces from the kernels, exact from the formulas.
struct LawPoint {
  double displacement = 0, force = 0, exact = 0;
};
struct LoadCycle {
  std::vector<LawPoint> points;
  double dissipated = 0, exact = 0;  // [F0 a] over one full cycle: 4 limit (amplitude - limit / stiffness)
};
std::vector<LawPoint> normal_curve(const LawScene& law, int points);
LoadCycle tangential_cycle(const LawScene& law, double overlap, double amplitude, int points);
LoadCycle rolling_cycle(const LawScene& law, double overlap, double amplitude, int points);

}  // namespace isostat::lab
