// The vectors of doubles that kernels are written for: Scalar, and Native, the widest of the instruction set that this
// translation unit is compiled for (8 lanes, 4, or 1). One source a kernel, a translation unit for each instruction set
// (CMake: isostat_kernel), chosen at run time (base/isa.hpp).
#pragma once
#include <experimental/simd>

#include "geometry/base/mul_add.hpp"
#if defined(__AVX2__)
#include <immintrin.h>
#endif
#if defined(__AVX512F__) && defined(__clang__)
#include "geometry/base/lanes512.hpp"
#endif

// Always inlined: a copy emitted out of line by the translation unit of one instruction set could be the one that the
// linker keeps for all of them.
#define ISOSTAT_INLINE [[gnu::always_inline]] inline

namespace isostat::kernel {

namespace stdx = std::experimental;
using Scalar = stdx::simd<double, stdx::simd_abi::scalar>;
#if defined(__AVX512F__) && defined(__clang__)
using Native = Lanes512;
#elif defined(__AVX512F__)
using Native = stdx::simd<double, stdx::simd_abi::__avx512>;
#elif defined(__AVX2__)
using Native = stdx::simd<double, stdx::simd_abi::__avx>;
#else
using Native = Scalar;
#endif

// x where the mask holds, else y.
template <class Abi>
ISOSTAT_INLINE stdx::simd<double, Abi> select(const stdx::simd_mask<double, Abi>& mask,
                                              const stdx::simd<double, Abi>& x, stdx::simd<double, Abi> y) {
  where(mask, y) = x;
  return y;
}

}  // namespace isostat::kernel

#if defined(__AVX512F__)
template <>
struct isostat::MulAdd<isostat::kernel::Native> {
  using V = isostat::kernel::Native;
  ISOSTAT_INLINE static V of(V a, V b, V c) {
    return V(_mm512_fmadd_pd(static_cast<__m512d>(a), static_cast<__m512d>(b), static_cast<__m512d>(c)));
  }
};
#elif defined(__AVX2__)
template <>
struct isostat::MulAdd<isostat::kernel::Native> {
  using V = isostat::kernel::Native;
  ISOSTAT_INLINE static V of(V a, V b, V c) {
    return V(_mm256_fmadd_pd(static_cast<__m256d>(a), static_cast<__m256d>(b), static_cast<__m256d>(c)));
  }
};
#endif
