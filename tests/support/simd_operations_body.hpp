// Included only by simd_operations_*.cpp.
#pragma once
#include "dem/disks/kernel/row.hpp"
#include "tests/support/simd_operations.hpp"

namespace isostat::kernel {

template <class V>
ISOSTAT_INLINE void simd_operations(const double* x, const double* y, std::size_t n, double* const* out) {
  for (std::size_t k = 0; k < n; k += V::size()) {
    const V a(x + k, stdx::element_aligned), b(y + k, stdx::element_aligned), zero(0.0);
    const auto keep = [&](SimdOperation operation, const V& v) {
      v.copy_to(out[operation] + k, stdx::element_aligned);
    };
    keep(kSum, a + b), keep(kDifference, a - b), keep(kProduct, a * b), keep(kQuotient, a / b), keep(kOpposite, -a);
    keep(kRoot, sqrt(max(a, -a)));
    keep(kLarger, max(a, b)), keep(kSmaller, min(a, b)), keep(kMulAdd, mul_add<V>(a, b, a));
    const auto less = a < b, negative = a < zero;
    keep(kChosenByLess, select(less, a, b));
    keep(kChosenByNot, select(!less, a, b));
    keep(kChosenByBoth, select(less && negative, a, b));
    keep(kMasked, select(negative && !less, -a, zero));
    keep(kAnyLess, V(any_of(less) ? 1.0 : 0.0));
    keep(kReduced, V(reduce(a)));
  }
}

}  // namespace isostat::kernel
