// Is a packing in mechanical equilibrium? The three criteria of Gilabert 2007, Sec. II.D, evaluated from positions,
// velocities and static link forces alone, so that solver, state file and analysis give the same answer.
#pragma once
#include <optional>
#include <string>

#include "dem/scene/scene.hpp"
#include "dem/state/packing.hpp"
#include "dem/state/state.hpp"

namespace isostat {

// A contact counts as yielded when |T| >= (1 - kYieldTolerance) mu N_e, and the same for the rolling moment.
inline constexpr double kYieldTolerance = 1e-6;
// Force below which a contact counts as unloaded, in units of F1 (Sec. II.D; coordination numbers without cohesion).
inline constexpr double kLoadTolerance = 1e-4;

// F1 = max(F0, a P) [F0], a = 1 the largest diameter; the unit of force where neither is positive.
double force_scale(const LawParameters& law, const ImposedStress& imposed);

// Normal force of the static law (Eqs. 4-5) at the gap h: [F0], repulsion positive.
double static_normal_force(double gap, const LawParameters& law);
// Its two branches, whatever the gap: of a contact, and of a distant link within reach.
double contact_normal_force(double gap, const LawParameters& law);
double distant_normal_force(double gap, const LawParameters& law);

// How far a contact is from yielding: 1 - |T| / (mu N_e) and 1 - |M| / (mu_r N_e), N_e = -K_N h (Eqs. 8, 10).
struct YieldMargin {
  double sliding = 1, rolling = 1;  // [-] 1 where the axis is absent; 0 at the limit; 0 if N_e <= 0
};
YieldMargin yield_margin(double gap, double tangential_force, double moment, const LawParameters& law);

// Kind of a link of a state: distant for gap >= 0, else by the yield margins.
LinkKind link_kind(double gap, double tangential_force, double moment, const LawParameters& law);

// Eq. 3 with each pair once, compression positive: (1/A) [sum m v_a v_b + sum over links F_a r_b], peculiar velocities,
// static forces. [F0/a]; rows a, columns b. Needs a cell.
struct StressTensor {
  double xx = 0, xy = 0, yx = 0, yy = 0;
};
StressTensor measured_stress(const Packing<2>& packing);

// O(grains + links). The kinetic energy is a mean over grains; without cohesion the grains that touch nothing do not
// count (they keep their spin for ever) unless none touches, and without friction spins do not count (no force acts on
// them). The pressure criterion applies to the directions with an imposed stress. `finishing` is left at "none".
Certificate evaluate_certificate(const Packing<2>& packing, const LawParameters& law, const ImposedStress& imposed,
                                 const EquilibriumScene& tolerance);
// From everything a state holds; keeps the state's record of its finishing method.
Certificate evaluate_certificate(const State& state);

// The criterion furthest from its tolerance (measured as value / tolerance), for progress messages.
struct WorstCriterion {
  std::string name;  // "force", "moment", "pressure", "kinetic energy"
  double ratio = 0;  // <= 1: met
};
WorstCriterion worst_criterion(const Certificate& certificate);

}  // namespace isostat
