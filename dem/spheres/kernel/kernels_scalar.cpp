#include "dem/spheres/kernel/pair_force_impl.hpp"

namespace isostat::spheres {

const KernelTable& scalar_kernels() {
  static constexpr KernelTable table = kernel_table<Scalar>(Supported{});
  return table;
}

}  // namespace isostat::spheres
