#include "geometry/overlap_batch_impl.hpp"

namespace isostat::kernel {

void overlap_batch_avx2(std::size_t n, const TriangleArrays& a, const TriangleArrays& b, const OverlapArrays& out) {
  overlap_batch_in<Native>(n, a, b, out);
}

}  // namespace isostat::kernel
