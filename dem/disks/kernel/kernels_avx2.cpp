#include "dem/disks/kernel/pair_force_impl.hpp"

namespace isostat::kernel {

const KernelTable& avx2_kernels() {
  static constexpr KernelTable table = kernel_table<Twin<Native>>(Supported{});
  return table;
}

}  // namespace isostat::kernel
