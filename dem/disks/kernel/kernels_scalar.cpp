#include "dem/disks/kernel/pair_force_impl.hpp"

namespace isostat::kernel {

const KernelTable& scalar_kernels() {
  static constexpr KernelTable table = kernel_table<Scalar>(Supported{});
  return table;
}

}  // namespace isostat::kernel
