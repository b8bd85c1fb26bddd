#include "dem/spheres/kernel/motion_impl.hpp"
#include "dem/spheres/kernel/motion_kernels.hpp"
#include "dem/spheres/kernel/pair_force_impl.hpp"

namespace isostat::spheres {

const KernelTable& scalar_kernels() {
  static constexpr KernelTable table = kernel_table<Scalar>(Supported{});
  return table;
}

SphereMotionKernel scalar_motion(SphereMotionNeeds needs) { return motion_kernel(needs); }

}  // namespace isostat::spheres
