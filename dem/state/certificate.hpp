// Is a packing in mechanical equilibrium? The three criteria of Gilabert 2007, Sec. II.D, evaluated from positions,
// velocities and static link forces alone, so that solver, state file and analysis give the same answer. Each system
// evaluates its own (evaluate_certificate() beside its law); what the numbers mean is said here.
#pragma once
#include <cmath>
#include <cstdint>
#include <string>

namespace isostat {

// Force below which a contact counts as unloaded, in units of F1 (Sec. II.D; coordination numbers without cohesion).
inline constexpr double kLoadTolerance = 1e-4;

struct Certificate {
  double max_force = 0;                 // [F1]
  double max_moment = 0;                // [F1 a]
  double pressure_error = 0;            // [F1/a] largest over the controlled directions and sigma_12; 0 in a fixed cell
  double kinetic_energy_per_grain = 0;  // [F1 a]
  double force_scale = 1;               // F1 = max(F0, a P) [F0]
  double tolerance_force = 1e-4, tolerance_pressure = 1e-4, tolerance_kinetic = 5e-8;
  std::int64_t sliding = 0;          // contacts with |T| >= (1 - 1e-6) mu N_e
  std::int64_t rolling_yielded = 0;  // contacts with |M| >= (1 - 1e-6) mu_r N_e
  double smallest_margin = 1;        // min over contacts of 1 - |T| / (mu N_e), and the same for rolling
  std::int64_t moving = 0;           // grains that still move: whose own kinetic energy is above the tolerance of the
                                     // mean, or that a static solve found driven in floppy or very soft modes
  // The largest of the stage so far (dem/run/loading.hpp); not a number where a stage does not load a network.
  double inertial_number = 0;  // [-]
  double stress_error = 0;     // [-] of the imposed stresses
  bool pressure_controlled = false;
  bool equilibrated = false;
  std::string finishing = "none";  // which finishing method acted, if any
};

// What a certificate says of how the packing came here, which its positions and forces do not tell.
inline void keep_record(Certificate& c, const Certificate& before) {
  c.finishing = before.finishing;
  c.inertial_number = before.inertial_number, c.stress_error = before.stress_error;
}

// max that keeps a NaN: a run that has blown up must never look balanced.
inline double largest_of(double a, double b) { return std::isnan(a) || b <= a ? a : b; }

// The criterion furthest from its tolerance (measured as value / tolerance), for progress messages.
struct WorstCriterion {
  std::string name;  // "force", "moment", "pressure", "kinetic energy"
  double ratio = 0;  // <= 1: met
};
WorstCriterion worst_criterion(const Certificate& certificate);

}  // namespace isostat
