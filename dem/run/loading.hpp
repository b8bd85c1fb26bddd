// How a stage loads the packing: whether it is still on its way to what it asks for, how far from quasi-static it is.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "dem/state/balance.hpp"
#include "dem/state/balance_3d.hpp"
#include "dem/state/certificate.hpp"
#include "dem/state/state.hpp"

namespace isostat {

// sigma_11, sigma_22(, sigma_33) of the static forces [F0/a]; 0 without a cell.
template <class System>
Vec<System::dimension> static_stress(const State<System>& s) {
  if (!s.packing.cell) return {};
  return diagonal(measured_stress(s));
}

// sigma_12 of the static forces [F0/a]; 0 without a cell.
template <class System>
double static_shear_stress(const State<System>& s) {
  return s.packing.cell ? shear_of(measured_stress(s)) : 0.0;
}

// K_N, or an imposed stress or rate, is still on its way.
template <class System>
bool still_loading(const State<System>& s, const StageScene& stage) {
  return law_changes(s, stage) || s.time + 0.5 * s.time_step < s.progress.start_time + stage.ramp_time;
}

inline constexpr double kNetwork =
    0.9;  // [loaded contacts a grain] a connected network has one at least, rattlers none
template <class System>
bool has_network(const State<System>& s) {
  return static_cast<double>(loaded_contacts(s)) >= kNetwork * static_cast<double>(count_free(s.packing));
}

// Whether the cell is driven, was and comes to rest, or is under a stress.
template <class System>
bool loads_cell(const State<System>& s, const StageScene& stage) {
  return s.packing.cell &&
         (stage.driven() || stage.ramp_time > 0 || largest_stress(imposed_stress<System::dimension>(stage)));
}
inline constexpr double kNotLookedAt = -1;  // of the certificate's largest numbers, between the opening of a stage and
                                            // its first look, which says whether it loads a network

// sqrt(m a / F1) [T0]: in which the scale of forces F1 = max(F0, a P) moves the heaviest grain, m, by its diameter a.
// Of round grains; triangles have their own.
template <class System>
double inertial_time(const State<System>& s, double pressure) {
  constexpr int D = System::dimension;
  const Bodies<D>& b = s.packing.bodies;
  double mass = 0, diameter = 0;
  for (std::size_t k = 0; k < b.size(); ++k)
    mass = std::max(mass, b.mass[k]), diameter = std::max(diameter, 2 * b.radius[k]);
  return std::sqrt(mass * diameter / std::max(s.law.attraction, pressure * std::pow(diameter, D - 1)));
}

// P [F0/a]: of the stresses that are imposed, or else measured, the largest.
template <class System>
double acting_pressure(const State<System>& s) {
  double largest = std::abs(largest_stress(s.imposed_stress).value_or(0));
  if (largest > 0) return largest;
  for (const double sigma : static_stress(s).c) largest = std::max(largest, std::abs(sigma));
  return largest;
}

// Inertial number of the fastest edge of the cell or of its shear, rate sqrt(m a / F1); 0 at rest. Below kQuasiStatic
// the time that loading takes does not show in dense flows of grains (GDR MiDi, Eur. Phys. J. E 14, 341 (2004)).
inline constexpr double kQuasiStatic = 1e-3;
template <class System>
double inertial_number(const State<System>& s) {
  double rate = 0;  // [1/T0]
  for (int a = 0; a < System::dimension; ++a)
    rate = std::max(
        rate, std::abs(s.cell_motion.strain_rate[a] * s.cell_motion.reference_length[a]) / s.packing.cell->length[a]);
  rate = std::max(
      rate, std::abs(s.cell_motion.shear_strain_rate * s.cell_motion.reference_length[1]) / s.packing.cell->length[1]);
  return rate > 0 ? rate * inertial_time(s, acting_pressure(s)) : 0;
}

// By how much the stress of an edge is out of the range between what was imposed when the stage began and what is
// imposed now, as a part of the larger of the two, or of kLeastStress where both are small.
inline constexpr double kLeastStress = 0.01;  // [F1/a]
inline constexpr double kStressHeld = 1;      // a larger error is told
template <class System>
double stress_error(const State<System>& s) {
  double largest = 0;
  const auto stress = static_stress(s);
  for (int a = 0; a < System::dimension; ++a) {
    const auto& imposed = s.imposed_stress[static_cast<std::size_t>(a)];
    if (!imposed) continue;
    const double low = std::min(s.progress.ramp_stress[a], *imposed),
                 high = std::max(s.progress.ramp_stress[a], *imposed);
    const double scale = std::max({-low, high, kLeastStress * s.certificate.force_scale});
    largest = largest_of(largest, std::max(low - stress[a], stress[a] - high) / scale);
  }
  return largest;
}

}  // namespace isostat
