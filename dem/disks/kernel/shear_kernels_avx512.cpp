#include "dem/disks/kernel/pair_force_impl.hpp"

namespace isostat::kernel {

const ShearKernelTable& avx512_shear_kernels() {
  static constexpr ShearKernelTable table = shear_kernel_table<Twin<Native>>(Supported{});
  return table;
}

}  // namespace isostat::kernel
