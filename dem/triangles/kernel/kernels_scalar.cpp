// Compiled with the flags of its instruction set; see dem/CMakeLists.txt.
#include "dem/triangles/kernel/kernels_impl.hpp"

namespace isostat::kernel {

TriangleKernels triangle_kernels_scalar(const OverlapNeeds& overlap, const BeamNeeds& beams, bool kinetic) {
  return kernels_of<Scalar>(overlap, beams, kinetic);
}

}  // namespace isostat::kernel
