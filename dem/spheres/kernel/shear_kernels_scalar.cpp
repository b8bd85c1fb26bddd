#include "dem/spheres/kernel/pair_force_impl.hpp"

namespace isostat::spheres {

const ShearKernelTable& scalar_shear_kernels() {
  static constexpr ShearKernelTable table = shear_kernel_table<Scalar>(Supported{});
  return table;
}

}  // namespace isostat::spheres
