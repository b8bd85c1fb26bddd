#include "dem/spheres/kernel/pair_force_impl.hpp"

namespace isostat::spheres {

const ShearKernelTable& avx512_shear_kernels() {
  static constexpr ShearKernelTable table = shear_kernel_table<Native>(Supported{});
  return table;
}

}  // namespace isostat::spheres
