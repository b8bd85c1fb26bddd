#include "dem/spheres/kernel/motion_impl.hpp"
#include "dem/spheres/kernel/motion_kernels.hpp"
#include "dem/spheres/kernel/pair_force_impl.hpp"

namespace isostat::spheres {

const KernelTable& avx2_kernels() {
  static constexpr KernelTable table = kernel_table<Native>(Supported{});
  return table;
}

SphereMotionKernel avx2_motion(SphereMotionNeeds needs) { return motion_kernel(needs); }

}  // namespace isostat::spheres
