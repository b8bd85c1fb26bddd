#include "dem/spheres/motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dem/spheres/kernel/motion_kernels.hpp"

namespace isostat {

double velocity_prediction(const SphereLaw& law, double stiffest, double time_step) {
  const double s = time_step * std::sqrt(stiffest);
  const double damping = 8 * std::numbers::sqrt2 * law.damping * s;
  if (!(damping > 0)) return 0.5;
  return std::clamp(0.5 * ((2 - 4 * s * s) / damping - 1), 0.0, 0.5);
}

SphereMotionKernel select_motion(SphereMotionNeeds needs, Isa isa) {
  return isa == Isa::avx512 ? spheres::avx512_motion(needs)
         : isa == Isa::avx2 ? spheres::avx2_motion(needs)
                            : spheres::scalar_motion(needs);
}

}  // namespace isostat
