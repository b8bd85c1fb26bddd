// Compiled with the flags of its instruction set; see dem/CMakeLists.txt.
#include "dem/triangles/kernel/kernels_impl.hpp"

namespace isostat::kernel {

TriangleKernels triangle_kernels_avx2(const OverlapNeeds& overlap, const BeamNeeds& beams, bool kinetic) {
  return kernels_of<Native>(overlap, beams, kinetic);
}

}  // namespace isostat::kernel
