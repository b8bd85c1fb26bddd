#include "dem/spheres/kernel/pair_force_impl.hpp"

namespace isostat::spheres {

const KernelTable& avx2_kernels() {
  static constexpr KernelTable table = kernel_table<Native>(Supported{});
  return table;
}

}  // namespace isostat::spheres
