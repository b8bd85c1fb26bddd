// The vector operations of the force kernels one by one, for each instruction set in a translation unit of its own
// (simd_operations_*.cpp), as the kernels are. Plain pointers only: nothing of the library may be compiled for a set
// that the machine lacks.
#pragma once
#include <cstddef>

namespace isostat {

enum SimdOperation : std::size_t {
  kSum,
  kDifference,
  kProduct,
  kQuotient,
  kOpposite,
  kRoot,
  kLarger,
  kSmaller,
  kMulAdd,  //
  kChosenByLess,
  kChosenByNot,
  kChosenByBoth,
  kMasked,  //
  kAnyLess,
  kReduced,  // of a batch, in all of its lanes
  kSimdOperations
};

// out[operation][0..n) of x and y; n is a multiple of 16. The three-operand ones take x, y, x.
using SimdOperations = void (*)(const double* x, const double* y, std::size_t n, double* const* out);
void simd_operations_scalar(const double* x, const double* y, std::size_t n, double* const* out);
void simd_operations_avx2(const double* x, const double* y, std::size_t n, double* const* out);
void simd_operations_avx512(const double* x, const double* y, std::size_t n, double* const* out);

}  // namespace isostat
