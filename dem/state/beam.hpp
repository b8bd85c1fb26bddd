// An elastic beam at rest: force and moment of its link, energy and stiffness. A beam joins the centres of two bodies;
// as a link it has the frame of two radii L0/2 (dem/state/link_ends.hpp). Poeschel and Buchholtz 1995, Eqs. 28-49, with
// the rest length L0 in EI/L and the length L in the lever arm, so that the forces are exactly those of the energy.
//
// T_a, T_b: rotations of the two ends against the chord, less their rest values [rad].
#pragma once
#include <cmath>

#include "dem/state/packing.hpp"

namespace isostat {

// Rotation of a direction fixed in a body against the chord: in (-pi, pi], so that no angle is ever counted or wrapped.
inline double end_rotation(const Vec2& carried, const Vec2& chord) {
  return std::atan2(chord[0] * carried[1] - chord[1] * carried[0], dot(chord, carried));
}

// The direction of the chord at rest in the frame of a body, whose rest angle is that of the frame against the chord:
// turned with the body, its end_rotation() is T_a or T_b itself.
inline Vec2 rest_direction(double rest_angle) { return {{std::cos(rest_angle), -std::sin(rest_angle)}}; }

struct BeamForce {
  double normal, tangential, moment;  // N, T, M of the link
};
// N = -E (L - L0), T = 6 EI (T_a + T_b) / (L0 L), M = -(EI/L0) (T_b - T_a): with lever arms L/2 the end moments are
// -T L/2 - M = -(EI/L0) (4 T_a + 2 T_b) on i and -T L/2 + M = -(EI/L0) (4 T_b + 2 T_a) on j.
inline BeamForce beam_force(const Beam& beam, double length, double turn_i, double turn_j) {
  const double bend = beam.bending / beam.rest_length;
  return {-beam.stiffness * (length - beam.rest_length), 6 * bend * (turn_i + turn_j) / length,
          -bend * (turn_j - turn_i)};
}

// U = E (L - L0)^2 / 2 + (EI/L0) (2 T_a^2 + 2 T_a T_b + 2 T_b^2)
inline double beam_energy(const Beam& beam, double length, double turn_i, double turn_j) {
  const double stretch = length - beam.rest_length;
  return 0.5 * beam.stiffness * stretch * stretch +
         2 * beam.bending / beam.rest_length * (turn_i * turn_i + turn_i * turn_j + turn_j * turn_j);
}

// Of the rows of G: K_N = E, K_T = 12 EI / (L0 L^2), K_r = EI / L0. The tangent has one term more than a contact's,
// dT = -T dL / L, for a stretched beam keeps T L.
struct BeamStiffness {
  double normal, tangential, rolling;
};
inline BeamStiffness beam_stiffness(const Beam& beam, double length) {
  const double bend = beam.bending / beam.rest_length;
  return {beam.stiffness, 12 * bend / (length * length), bend};
}

// The dampers, Eqs. 50-53: N = -gamma dL/dt, end moments -(gamma I/L0) dT_a/dt and -(gamma I/L0) dT_b/dt with
// I = (E I)/E. As printed they have moments without a couple of forces and turn an isolated pair; a beam is a link, so
// its force across the chord, -(M_A + M_B)/L, comes with its lever arms and balances them. In the rows of the link the
// dampers are then diagonal: (N, T, M) = -(c_N v_N, c_T v_T, c_R v_R), which takes energy at any velocities.
// gamma [force per velocity].
struct BeamDamping {
  double normal, tangential, rolling;
};
inline BeamDamping beam_damping(const Beam& beam, double gamma, double length) {
  const double bend = gamma * (beam.bending / beam.stiffness) / beam.rest_length;
  return {gamma, 2 * bend / (length * length), bend / 2};
}

// The beam of a network that says no more than which bodies it joins: without load as it stands, with the default
// stiffnesses of that paper in the units of the file (E = 1e5 g/s^2, E I = 10 g cm^3/s^2).
inline Beam beam_at_rest(double length) { return {length, 0, 0, 1e5, 10}; }

}  // namespace isostat
