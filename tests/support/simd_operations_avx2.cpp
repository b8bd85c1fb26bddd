#include "tests/support/simd_operations_body.hpp"

namespace isostat {

void simd_operations_avx2(const double* x, const double* y, std::size_t n, double* const* out) {
  kernel::simd_operations<kernel::Twin<kernel::Native>>(x, y, n, out);
}

}  // namespace isostat
