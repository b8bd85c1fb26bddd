// What one step asks of the bodies beside their own motion: the cell carries them, a drag brakes them.
#pragma once

namespace isostat {

struct MotionStep {
  double time_step = 0;           // dt [T0]
  double time = 0;                // [T0] at its end
  double scale[2] = {1, 1};       // L(n+1) / L(n): positions are rescaled with the cell
  double half_scale[2] = {1, 1};  // L(n+1) / L(n+1/2)
  double keep[2] = {1, 1};        // velocity kept over the step: 1 - drag dt (- rate coupling)
  double keep_spin = 1;
};

}  // namespace isostat
