// Of the baseline of the architecture: two lanes on x86-64.
#include "geometry/overlap_batch_impl.hpp"

namespace isostat::kernel {

void overlap_batch_scalar(std::size_t n, const TriangleArrays& a, const TriangleArrays& b, const OverlapArrays& out) {
  overlap_batch_in<stdx::native_simd<double>>(n, a, b, out);
}

}  // namespace isostat::kernel
