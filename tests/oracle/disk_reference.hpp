// The obvious disk solver: every pair and every image looked at in every step, plain doubles, no lists, no rows, no
// batches. Written from Gilabert 2007 (Eqs. 1-10, A1-A3), PHYSICS.md sec. 1 and the schemes stated in
// dem/disks/motion.hpp and dem/solver/barostat.hpp; shares no code with the solver. O(N^2) a step.
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "dem/disks/disks.hpp"
#include "dem/solver/barostat.hpp"

namespace isostat::oracle {

// One pair at one instant, with everything its law can ask for. j minus i.
struct PairMoment {
  double x = 0, y = 0;  // branch vector [a]
  double radius_i = 0, radius_j = 0;
  double mass_i = 0, mass_j = 0;
  double u = 0, v = 0;                // relative velocity at the half step, affine part included
  double spin_i = 0, spin_j = 0;      // at the half step
  double p = 0, q = 0;                // relative velocity predicted to the full step, affine part included
  double tangential = 0, moment = 0;  // springs before the step
  double time_step = 0;
};

struct PairResponse {
  double gap = 0;
  double fx = 0, fy = 0;              // force on j
  double moment_i = 0, moment_j = 0;  // about the centres
  double tangential = 0, moment = 0;  // springs after the step
  double viscous_force = 0;           // part of the normal force
  double sliding = 0, rolling = 0;    // energy that the yield limits have dissipated
};
PairResponse pair_response(const DiskLaw& law, const PairMoment& pair);

struct DiskMoment {
  std::int64_t id = 0;
  double x = 0, y = 0, u = 0, v = 0, w = 0;  // never wrapped; half-step velocity and spin
  double p = 0, q = 0;                       // predicted velocity
  double fx = 0, fy = 0, torque = 0;
  double radius = 0, mass = 0, inertia = 0;
  double velocity_x(double dt) const { return u + 0.5 * dt * fx / mass; }  // at the full step
  double velocity_y(double dt) const { return v + 0.5 * dt * fy / mass; }
  double spin(double dt) const { return w + 0.5 * dt * torque / inertia; }
};

class DiskReference {
 public:
  // Positions, full-step velocities and spins, cell, law, springs of the links; the solver's memory is not looked at.
  DiskReference(const State<Disks>& state, const CellControl<2>& control);
  void step();
  void set_drag(double rate) { drag_ = rate; }

  const std::vector<DiskMoment>& disks() const { return disks_; }
  const DiskMoment& disk(std::int64_t id) const;
  std::array<double, 2> length() const { return length_; }
  std::array<double, 2> strain_rate() const { return rate_; }
  std::array<double, 2> stress() const { return stress_; }
  // Of a cell that shears: the tilt is never lowered, however far it goes.
  double tilt() const { return tilt_; }
  double shear_strain_rate() const { return shear_rate_; }
  double shear_stress() const { return shear_stress_; }
  struct Spring {
    double tangential = 0, moment = 0;
  };
  // Springs by (smaller index, larger index, s1, s2) over disks() as they stand.
  const std::map<std::array<int, 4>, Spring>& springs() const { return springs_; }
  std::size_t interactions() const { return interactions_; }  // pairs and images within reach at the last step
  const EnergyLedger& ledger() const { return ledger_; }

 private:
  void forces(double dt);
  void stress(double virial_x, double virial_y, double kinetic_x, double kinetic_y);
  double limited(double rate, double reference) const;

  DiskLaw law_;
  CellControl<2> control_;
  double dt_ = 0, drag_ = 0;
  std::array<double, 2> length_{}, reference_{}, rate_{}, stress_{}, flow_half_{}, flow_now_{};
  double tilt_ = 0, shear_rate_ = 0, shear_stress_ = 0, shear_half_ = 0, shear_now_ = 0;
  std::vector<DiskMoment> disks_;
  std::map<std::array<int, 4>, Spring> springs_;
  std::size_t interactions_ = 0;
  EnergyLedger ledger_;
};

}  // namespace isostat::oracle
