// The dimensionless numbers of a run (Gilabert 2007, Sec. II.C and Table I), and the critical time step.
#pragma once
#include <optional>

#include "dem/disks/disks.hpp"

namespace isostat {

struct Scales {
  double force = 0;                          // F1 = max(F0, a P) [F0]; 0 if neither acts
  std::optional<double> kappa;               // a K_N / F1; none without force scale
  std::optional<double> reduced_pressure;    // P* = a P / F0; without cohesion P in the scene's unit; none: fixed cell
  std::optional<double> overlap_over_range;  // h0 / D0 = F0 / (K_N D0); none without cohesion
  double restitution = 1;                    // e_N = exp(-pi zeta / sqrt(1 - zeta^2)) of two free disks
  std::optional<double> velocity;            // V* = sqrt(F0 D0 / m) [a/T0]; of a law without cohesion alone none
  std::optional<double> time;     // T0 = sqrt(m a / F0), without cohesion sqrt(m / P) [T0 of the scene's unit]
  double time_step = 0;           // dt [T0]
  double critical_time_step = 0;  // 2 / omega_max of critical_time_step() [T0]
};

// diameter_min: of the smallest grain [a]; the mass of a disk is d^2 [m].
Scales scales(const DiskLaw& law, std::optional<double> pressure, double diameter_min, double time_step);
// With V* of the scene, if it is one of stages, where there is no cohesion (velocity_unit() of
// dem/solver/agitation.hpp).
Scales scales(const State<Disks>& state);

// dt = fraction * sqrt(m_max / K_N) [T0].
double time_step(const DiskLaw& law, double fraction, double heaviest);

// Largest stable step of the undamped central-difference scheme, dt < 2 / omega_max [T0], with omega_max bounded for
// a grain (mass m, by default d^2, inertia m d^2 / 8) among neighbours as small and as light, at most six of them in
// the plane: the sum of contact stiffnesses per grain counts twice because the neighbour may move in antiphase.
//   translation  omega^2 = 2 * 6/2 (K_N + K_T) / m  (averaged over directions n n + t t = 1)
//   rotation     omega^2 = 2 * 6 (K_T d^2/4 + K_r) / I = 24 K_T / m + 96 K_r / (m d^2)
// The rotational value is reached, for K_r = 0, by equal disks on a triangular lattice all spinning alike.
double critical_time_step(const DiskLaw& law, double diameter, double mass);
inline double critical_time_step(const DiskLaw& law, double diameter) {
  return critical_time_step(law, diameter, diameter * diameter);
}
// Of the free grain that bears least; infinite if none is left.
double critical_time_step(const DiskLaw& law, const Packing<2>& packing);

// SI values of the units of a scene, and of what is derived from them.
struct SiScales {
  double length;                                      // a [m]
  double mass;                                        // m = density pi a^2 / 4 [kg]
  double force;                                       // F0 [N]
  double time;                                        // sqrt(m a / F0) [s]
  double velocity() const { return length / time; }   // a / unit of time [m/s]
  double pressure() const { return force / length; }  // stress in the plane and stiffness [N/m]
};
SiScales si_scales(const UnitsScene& units);

}  // namespace isostat
