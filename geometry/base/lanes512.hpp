// Eight doubles in an AVX-512 register, with the operations of <experimental/simd> that the kernels use, by intrinsics:
// for clang. clang 14 compiles comparisons, masked assignment and the logic of masks of libstdc++ 12's
// simd<double, simd_abi::__avx512> to wrong code at every level of optimisation (tests/dem/simd_test.cpp shows it);
// the arithmetic is right, and IEEE operations have the same bits either way.
#pragma once
#if defined(__AVX512F__)
#include <immintrin.h>

#include <cstddef>
#include <experimental/simd>

#define ISOSTAT_LANES [[gnu::always_inline]] friend inline

namespace isostat::kernel {

class Lanes512 {
 public:
  struct mask_type {
    __mmask8 bits;
    ISOSTAT_LANES mask_type operator&&(mask_type m, mask_type n) { return {_kand_mask8(m.bits, n.bits)}; }
    ISOSTAT_LANES mask_type operator||(mask_type m, mask_type n) { return {_kor_mask8(m.bits, n.bits)}; }
    ISOSTAT_LANES mask_type operator!(mask_type m) { return {_knot_mask8(m.bits)}; }
    ISOSTAT_LANES bool any_of(mask_type m) { return m.bits != 0; }
  };

  static constexpr std::size_t size() { return 8; }
  Lanes512() = default;
  [[gnu::always_inline]] explicit Lanes512(__m512d v) : v_(v) {}
  [[gnu::always_inline]] explicit Lanes512(double x) : v_(_mm512_set1_pd(x)) {}
  template <class Flags>
  [[gnu::always_inline]] Lanes512(const double* p, Flags) : v_(_mm512_loadu_pd(p)) {}
  template <class Flags>
  [[gnu::always_inline]] void copy_to(double* p, Flags) const {
    _mm512_storeu_pd(p, v_);
  }
  [[gnu::always_inline]] explicit operator __m512d() const { return v_; }

  ISOSTAT_LANES Lanes512 operator+(Lanes512 x, Lanes512 y) { return Lanes512(_mm512_add_pd(x.v_, y.v_)); }
  ISOSTAT_LANES Lanes512 operator-(Lanes512 x, Lanes512 y) { return Lanes512(_mm512_sub_pd(x.v_, y.v_)); }
  ISOSTAT_LANES Lanes512 operator*(Lanes512 x, Lanes512 y) { return Lanes512(_mm512_mul_pd(x.v_, y.v_)); }
  ISOSTAT_LANES Lanes512 operator/(Lanes512 x, Lanes512 y) { return Lanes512(_mm512_div_pd(x.v_, y.v_)); }
  ISOSTAT_LANES Lanes512 operator-(Lanes512 x) { return Lanes512(_mm512_xor_pd(x.v_, _mm512_set1_pd(-0.0))); }
  ISOSTAT_LANES Lanes512 sqrt(Lanes512 x) { return Lanes512(_mm512_sqrt_pd(x.v_)); }
  // Of equal arguments (zeros of either sign) the first, as std::max and std::min; the instructions give the second.
  ISOSTAT_LANES Lanes512 max(Lanes512 x, Lanes512 y) { return Lanes512(_mm512_max_pd(y.v_, x.v_)); }
  ISOSTAT_LANES Lanes512 min(Lanes512 x, Lanes512 y) { return Lanes512(_mm512_min_pd(y.v_, x.v_)); }
  ISOSTAT_LANES double reduce(Lanes512 x) {
    return std::experimental::reduce(
        std::experimental::simd<double, std::experimental::simd_abi::__avx512>(x.v_));  // in the same order
  }

  ISOSTAT_LANES mask_type operator<(Lanes512 x, Lanes512 y) { return {_mm512_cmp_pd_mask(x.v_, y.v_, _CMP_LT_OS)}; }
  ISOSTAT_LANES mask_type operator>(Lanes512 x, Lanes512 y) { return y < x; }
  // where(mask, y) = x: x in the lanes of the mask.
  struct Where {
    mask_type mask;
    Lanes512& y;
    [[gnu::always_inline]] void operator=(Lanes512 x) { y.v_ = _mm512_mask_blend_pd(mask.bits, y.v_, x.v_); }
  };
  ISOSTAT_LANES Where where(mask_type m, Lanes512& y) { return {m, y}; }
  ISOSTAT_LANES Lanes512 select(mask_type m, Lanes512 x, Lanes512 y) {
    return Lanes512(_mm512_mask_blend_pd(m.bits, y.v_, x.v_));
  }

 private:
  __m512d v_;
};

}  // namespace isostat::kernel
#endif
