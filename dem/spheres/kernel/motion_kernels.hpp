// The motion kernels of spheres by instruction set.
#pragma once
#include "dem/spheres/motion.hpp"

namespace isostat::spheres {

SphereMotionKernel scalar_motion(SphereMotionNeeds needs);
SphereMotionKernel avx2_motion(SphereMotionNeeds needs);
SphereMotionKernel avx512_motion(SphereMotionNeeds needs);

}  // namespace isostat::spheres
