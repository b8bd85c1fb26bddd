// Rows of spheres to lanes and back for four pairs (row.hpp).
#pragma once
#include "dem/spheres/kernel/row.hpp"
#if defined(__AVX2__) && !defined(__AVX512F__)
#include <immintrin.h>

namespace isostat::spheres {

struct FourColumns {
  Native c[4];
};
ISOSTAT_INLINE FourColumns transposed(const __m256d r[4]) {
  const __m256d s0 = _mm256_unpacklo_pd(r[0], r[1]), s1 = _mm256_unpackhi_pd(r[0], r[1]);
  const __m256d s2 = _mm256_unpacklo_pd(r[2], r[3]), s3 = _mm256_unpackhi_pd(r[2], r[3]);
  return {{Native(_mm256_permute2f128_pd(s0, s2, 0x20)), Native(_mm256_permute2f128_pd(s1, s3, 0x20)),
           Native(_mm256_permute2f128_pd(s0, s2, 0x31)), Native(_mm256_permute2f128_pd(s1, s3, 0x31))}};
}

// Columns at .. at + 3 of  j + sign * i.
template <int kWidth>
ISOSTAT_INLINE FourColumns quad(const double* rows, const RowOffset* i, const RowOffset* j, int at, __m256d sign) {
  __m256d r[4];
  for (int k = 0; k < 4; ++k)
    r[k] = _mm256_fmadd_pd(_mm256_load_pd(row_at<kWidth>(rows, i[k]) + at), sign,
                           _mm256_load_pd(row_at<kWidth>(rows, j[k]) + at));
  return transposed(r);
}

template <bool kFirstLine>
ISOSTAT_INLINE PairDifference<Native> load_differences(const double* rows, const RowOffset* i, const RowOffset* j,
                                                       Native) {
  const __m256d minus = _mm256_set1_pd(-1), one_minus = _mm256_setr_pd(-1, 1, 1, 1), plus = _mm256_set1_pd(1);
  const FourColumns a = quad<kRowWidth>(rows, i, j, 0, minus), b = quad<kRowWidth>(rows, i, j, 4, minus);
  PairDifference<Native> d;
  d.r = {a.c[0], a.c[1], a.c[2]}, d.velocity = {a.c[3], b.c[0], b.c[1]};
  if constexpr (!kFirstLine) {
    const FourColumns e = quad<kRowWidth>(rows, i, j, 8, one_minus), f = quad<kRowWidth>(rows, i, j, 12, plus);
    d.half_velocity = {b.c[2], b.c[3], e.c[0]};
    d.half_surface_sum = {e.c[1], e.c[2], e.c[3]}, d.surface_sum = {f.c[0], f.c[1], f.c[2]};
  }
  return d;
}
ISOSTAT_INLINE Real3<Native> load_spin_difference(const double* spins, const RowOffset* i, const RowOffset* j, Native) {
  const FourColumns a = quad<kSpinWidth>(spins, i, j, 0, _mm256_set1_pd(-1));
  return {a.c[0], a.c[1], a.c[2]};
}

ISOSTAT_INLINE Native look_up(const double* table, const std::uint8_t* codes, Native) {
  return Native(_mm256_setr_pd(table[codes[0]], table[codes[1]], table[codes[2]], table[codes[3]]));
}

// Columns to rows; to those of j as they are, to those of i times sign.
template <int kWidth>
ISOSTAT_INLINE void add_quad(double* loads, const RowOffset* i, const RowOffset* j, int at, __m256d sign,
                             const __m256d columns[4]) {
  const FourColumns f = transposed(columns);
  for (int k = 0; k < 4; ++k) {
    double *on_i = row_at<kWidth>(loads, i[k]) + at, *on_j = row_at<kWidth>(loads, j[k]) + at;
    const __m256d load = static_cast<__m256d>(f.c[k]);
    const __m256d j_now = _mm256_add_pd(_mm256_load_pd(on_j), load);
    const __m256d i_now = _mm256_fmadd_pd(load, sign, _mm256_load_pd(on_i));
    _mm256_store_pd(on_j, j_now), _mm256_store_pd(on_i, i_now);
  }
}
ISOSTAT_INLINE void add_loads(double* loads, const RowOffset* i, const RowOffset* j, const Real3<Native>& f,
                              const Real3<Native>& a) {
  const __m256d zero = _mm256_setzero_pd();
  const __m256d lower[4] = {static_cast<__m256d>(f[0]), static_cast<__m256d>(f[1]), static_cast<__m256d>(f[2]),
                            static_cast<__m256d>(a[0])};
  const __m256d upper[4] = {static_cast<__m256d>(a[1]), static_cast<__m256d>(a[2]), zero, zero};
  add_quad<kLoadWidth>(loads, i, j, 0, _mm256_setr_pd(-1, -1, -1, 1), lower);
  add_quad<kLoadWidth>(loads, i, j, 4, _mm256_set1_pd(1), upper);
}
ISOSTAT_INLINE void add_forces(double* loads, const RowOffset* i, const RowOffset* j, const Real3<Native>& f) {
  const __m256d columns[4] = {static_cast<__m256d>(f[0]), static_cast<__m256d>(f[1]), static_cast<__m256d>(f[2]),
                              _mm256_setzero_pd()};
  add_quad<kLoadWidth>(loads, i, j, 0, _mm256_set1_pd(-1), columns);
}
ISOSTAT_INLINE void add_moments(double* moments, const RowOffset* i, const RowOffset* j, const Real3<Native>& m) {
  const __m256d columns[4] = {static_cast<__m256d>(m[0]), static_cast<__m256d>(m[1]), static_cast<__m256d>(m[2]),
                              _mm256_setzero_pd()};
  add_quad<kSpinWidth>(moments, i, j, 0, _mm256_set1_pd(-1), columns);
}

}  // namespace isostat::spheres
#endif
