// The degrees of freedom of the cell (Gilabert 2007, Eq. 3):  M d2(eps_a)/dt2 = sigma_imposed - sigma_aa, with
// eps_a' = -L_a' / L0_a, compression positive, L0 the cell at the start of the stage, and caps on the rate and on
// |L_a'|. A direction may have its rate imposed instead. Beyond the paper the cell may be damped, and what is imposed
// may come by a ramp.
//
// Shear is one more, with the same mass: eps_12' = -s / L0_2, where s is the part of the tilt's rate that is no stretch
// of the first edge:  tilt' = (L1'/L1) tilt + s. So the velocity gradient is L1'/L1, L2'/L2 and s/L2, each driven by
// its own stress whatever the tilt is, and nothing depends on which of the equivalent tilts describes the cell.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "dem/solver/motion_step.hpp"
#include "dem/state/state.hpp"
#include "geometry/periodic_cell.hpp"

namespace isostat {

// Imposed stresses and rates come linearly in time from what they were to what is asked for.
template <int D>
struct CellRamp {
  double start = 0, length = 0;             // [T0]; length 0: at once
  Vec<D> stress{};                          // [F0/a] at the start, along edges with an imposed stress
  Vec<D> strain_rate{};                     // [1/T0] at the start, along the others
  double shear_stress = 0, shear_rate = 0;  // [F0/a], [1/T0] at the start, as those of CellControl
  double left(double time) const { return length > 0 ? std::clamp(1 - (time - start) / length, 0.0, 1.0) : 0.0; }
};

template <int D>
struct CellControl {
  ImposedStress<D> stress;     // [F0/a]
  Vec<D> strain_rate{};        // [1/T0] imposed along an edge without imposed stress; 0: fixed
  double shear_rate = 0;       // [1/T0] s/L2 imposed without imposed shear stress; 0: no shear
  double max_strain_rate = 0;  // [1/T0]; 0: no cap
  double max_edge_speed = std::numeric_limits<double>::infinity();  // [a/T0] of |Ldot| under an imposed stress
  double inertia = 1;                                               // M [m]
  double damping = 0;                                               // [1/T0] of the cell's strain rate
  bool rate_coupling = false;                                       // peculiar velocities also feel -(Ldot/L) v
  CellRamp<D> ramp;
  bool shears() const { return stress.shear || shear_rate != 0 || (ramp.length > 0 && ramp.shear_rate != 0); }
  bool moves() const {
    return largest_stress(stress) || strain_rate != Vec<D>{} || shears() ||
           (ramp.length > 0 && ramp.strain_rate != Vec<D>{});
  }
  // What is imposed at a time: a function of the time alone, after the ramp the same to the bit as without one.
  CellControl at(double time) const {
    const double left = ramp.left(time);
    if (left == 0) return *this;
    CellControl now = *this;
    for (int a = 0; a < D; ++a) {
      auto& imposed = now.stress[static_cast<std::size_t>(a)];
      if (imposed) *imposed += left * (ramp.stress[a] - *imposed);
      now.strain_rate[a] += left * (ramp.strain_rate[a] - now.strain_rate[a]);
    }
    if (now.stress.shear) *now.stress.shear += left * (ramp.shear_stress - *now.stress.shear);
    now.shear_rate += left * (ramp.shear_rate - now.shear_rate);
    return now;
  }
};

// The velocity gradient that the bodies' affine velocities have [1/T0].
template <int D>
struct CellFlow {
  std::array<double, D> half{};          // Ldot_a / L_a at the half step
  std::array<double, D> now{};           // predicted to the full step
  double shear_half = 0, shear_now = 0;  // d(v_x)/dy
};

// Moves the cell by dt and says how positions are to be rescaled.
template <int D>
CellFlow<D> advance_cell(const CellControl<D>& control, double dt, CellMotion<D>& motion, PeriodicCell<D>& cell,
                         MotionStep<D>& step) {
  CellFlow<D> flow;
  const PeriodicCell<D> old = cell;
  const auto driven = [&](double stress, double measured, double before, double length) {
    double rate = before + dt * (stress - measured) / control.inertia;
    if (control.damping > 0) rate /= 1 + control.damping * dt;
    if (control.max_strain_rate > 0) rate = std::clamp(rate, -control.max_strain_rate, control.max_strain_rate);
    const double fastest = control.max_edge_speed / length;
    return std::clamp(rate, -fastest, fastest);
  };
  for (int a = 0; a < D; ++a) {
    const auto u = static_cast<std::size_t>(a);
    const double before = motion.strain_rate[a];
    const auto& stress = control.stress[u];
    const double rate =
        stress ? driven(*stress, motion.stress[a], before, motion.reference_length[a]) : control.strain_rate[a];
    const double ldot = -rate * motion.reference_length[a];
    const double ldot_now = ldot - 0.5 * (rate - before) * motion.reference_length[a];
    const double old_length = cell.length[a], half_length = old_length + 0.5 * dt * ldot;
    cell.length[a] = old_length + dt * ldot;
    motion.strain_rate[a] = rate;
    step.scale[u] = cell.length[a] / old_length;
    step.half_scale[u] = cell.length[a] / half_length;
    flow.half[u] = ldot / half_length;
    flow.now[u] = ldot_now / cell.length[a];
    if (control.rate_coupling) step.keep[u] -= dt * flow.half[u];
  }
  cell.tilt = step.scale[0] * old.tilt;
  if (!control.shears()) return flow;
  const double before = motion.shear_strain_rate, reference = motion.reference_length[1];
  const double rate = control.stress.shear ? driven(*control.stress.shear, motion.shear_stress, before, reference)
                                           : -control.shear_rate * old.length[1] / reference;
  const double moved = -rate * reference * dt;
  motion.shear_strain_rate = rate;
  cell.tilt += moved;
  // Positions move by the matrix that takes the edges of the old cell, or of the one midway, to those of the new.
  const double half_length = 0.5 * (old.length[1] + cell.length[1]), half_tilt = 0.5 * (old.tilt + cell.tilt);
  step.shear = moved / old.length[1];
  step.half_shear = (cell.tilt - step.half_scale[0] * half_tilt) / half_length;
  flow.shear_half = moved / dt * (1 - 0.5 * dt * flow.half[0]) / half_length;
  flow.shear_now = (moved / dt - 0.5 * (rate - before) * reference) / cell.length[1];
  motion.shear_strain += dt * flow.shear_half;
  if (control.rate_coupling) step.shear_coupling = dt * flow.shear_half;
  step.turns = cell.turns();
  cell.tilt -= step.turns * cell.length[0];
  return flow;
}

}  // namespace isostat
