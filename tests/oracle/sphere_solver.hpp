// The obvious solver of spheres in a periodic cell: every pair and the images around the nearest looked at in every
// step, no lists, no rows, no batches. Pairs by oracle::pair_response(), motion and cell written from the schemes
// stated in dem/spheres/motion.hpp, dem/solver/barostat.hpp and docs/shear.md; spheres are never wrapped and the tilt
// is never lowered. O(N^2) a step. Velocities are predicted by half a step: what the solver does where that is stable.
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "dem/solver/barostat.hpp"
#include "dem/spheres/spheres.hpp"

namespace isostat::oracle {

struct SphereMoment {
  std::int64_t id = 0;
  Vec3 r{}, half_velocity{}, half_spin{};  // velocities are peculiar
  Vec3 velocity{}, spin{};                 // predicted to the full step
  Vec3 force{}, torque{};
  double radius = 0, mass = 0, inertia = 0;
};

class SphereSolver {
 public:
  // Positions, full-step velocities and spins, cell, law, springs of the links; the solver's memory is not looked at.
  SphereSolver(const State<Spheres>& state, const CellControl<3>& control);
  void step();
  void set_drag(double rate) { drag_ = rate; }

  const SphereMoment& sphere(std::int64_t id) const;
  Vec3 length() const { return length_; }
  double tilt() const { return tilt_; }
  double shear_strain_rate() const { return shear_rate_; }
  double shear_stress() const { return shear_stress_; }
  Vec3 stress() const { return stress_; }
  std::size_t contacts() const { return springs_.size(); }  // with friction, at the last step
  double total_spring() const;                              // sum of |T|

 private:
  void forces(double dt);
  double limited(double rate, double reference) const;

  SphereLaw law_;
  CellControl<3> control_;
  double dt_ = 0, drag_ = 0;
  Vec3 length_{}, reference_{}, rate_{}, stress_{}, flow_half_{}, flow_now_{};
  double tilt_ = 0, shear_rate_ = 0, shear_stress_ = 0, shear_half_ = 0, shear_now_ = 0;
  std::vector<SphereMoment> spheres_;
  struct Spring {
    Vec3 tangential{}, moment{};
  };
  std::map<std::array<int, 5>, Spring> springs_;  // by i < j and shift
};

}  // namespace isostat::oracle
