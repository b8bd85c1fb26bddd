// What one step asks of the bodies beside their own motion: the cell carries them, a drag brakes them.
#pragma once
#include <array>

namespace isostat {

template <int D>
struct MotionStep {
  static constexpr std::array<double, D> ones() {
    std::array<double, D> one;
    one.fill(1.0);
    return one;
  }
  double time_step = 0;                       // dt [T0]
  double time = 0;                            // [T0] at its end
  std::array<double, D> scale = ones();       // L(n+1) / L(n): positions are rescaled with the cell
  std::array<double, D> half_scale = ones();  // L(n+1) / L(n+1/2)
  std::array<double, D> keep = ones();        // velocity kept over the step: 1 - drag dt (- rate coupling)
  double keep_spin = 1;
  // A cell that shears also moves positions along x: by shear y, and by half_shear times the move along y of the step
  // itself. Velocities lose shear_coupling v_y along x (see cell.rate_coupling).
  double shear = 0, half_shear = 0, shear_coupling = 0;
  int turns = 0;  // of the cell at the end of the step: PeriodicCell::turns()
};

}  // namespace isostat
