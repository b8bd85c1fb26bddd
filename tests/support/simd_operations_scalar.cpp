#include "tests/support/simd_operations_body.hpp"

namespace isostat {

void simd_operations_scalar(const double* x, const double* y, std::size_t n, double* const* out) {
  kernel::simd_operations<kernel::Scalar>(x, y, n, out);
}

}  // namespace isostat
