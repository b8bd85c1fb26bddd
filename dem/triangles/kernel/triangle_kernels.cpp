#include "dem/triangles/kernel/triangle_kernels.hpp"

namespace isostat {

TriangleKernels triangle_kernels(const OverlapNeeds& overlap, const BeamNeeds& beams, bool kinetic, Isa isa) {
#if defined(__x86_64__)
  if (isa == Isa::avx512) return kernel::triangle_kernels_avx512(overlap, beams, kinetic);
  if (isa == Isa::avx2) return kernel::triangle_kernels_avx2(overlap, beams, kinetic);
#endif
  return kernel::triangle_kernels_scalar(overlap, beams, kinetic);
}

}  // namespace isostat
