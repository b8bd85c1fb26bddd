// Rows of spheres to lanes and back for eight pairs (row.hpp).
#pragma once
#include "dem/spheres/kernel/row.hpp"
#if defined(__AVX512F__)
#include <immintrin.h>

namespace isostat::spheres {

struct EightColumns {
  __m512d c[8];
};
ISOSTAT_INLINE EightColumns transposed(const __m512d r[8]) {
  __m512d s[8], t[8];
  for (int k = 0; k < 8; k += 2) {
    s[k] = _mm512_unpacklo_pd(r[k], r[k + 1]);
    s[k + 1] = _mm512_unpackhi_pd(r[k], r[k + 1]);
  }
  for (int k = 0; k < 8; k += 4)
    for (int h = 0; h < 2; ++h) {
      t[k + h] = _mm512_shuffle_f64x2(s[k + h], s[k + h + 2], 0x88);
      t[k + h + 2] = _mm512_shuffle_f64x2(s[k + h], s[k + h + 2], 0xdd);
    }
  // t[0]: columns 0 and 4 of rows 0-3, t[2]: columns 2 and 6; t[1], t[3]: the odd ones; t[4..7]: rows 4-7.
  EightColumns e;
  for (int k = 0; k < 4; ++k) {
    e.c[k] = _mm512_shuffle_f64x2(t[k], t[k + 4], 0x88);
    e.c[k + 4] = _mm512_shuffle_f64x2(t[k], t[k + 4], 0xdd);
  }
  return e;
}
ISOSTAT_INLINE Real3<Native> natives(__m512d a, __m512d b, __m512d c) { return {Native(a), Native(b), Native(c)}; }

template <bool kFirstLine>
ISOSTAT_INLINE PairDifference<Native> load_differences(const double* rows, const RowOffset* i, const RowOffset* j,
                                                       Native) {
  __m512d line[8];
  for (int k = 0; k < 8; ++k)
    line[k] =
        _mm512_sub_pd(_mm512_load_pd(row_at<kRowWidth>(rows, j[k])), _mm512_load_pd(row_at<kRowWidth>(rows, i[k])));
  const EightColumns a = transposed(line);
  PairDifference<Native> d;
  d.r = natives(a.c[0], a.c[1], a.c[2]), d.velocity = natives(a.c[3], a.c[4], a.c[5]);
  if constexpr (!kFirstLine) {
    const __m512d sign = _mm512_setr_pd(-1, 1, 1, 1, 1, 1, 1, 1);
    for (int k = 0; k < 8; ++k)
      line[k] = _mm512_fmadd_pd(_mm512_load_pd(row_at<kRowWidth>(rows, i[k]) + 8), sign,
                                _mm512_load_pd(row_at<kRowWidth>(rows, j[k]) + 8));
    const EightColumns b = transposed(line);
    d.half_velocity = natives(a.c[6], a.c[7], b.c[0]);
    d.half_surface_sum = natives(b.c[1], b.c[2], b.c[3]), d.surface_sum = natives(b.c[4], b.c[5], b.c[6]);
  }
  return d;
}

// Two rows of four side by side: pairs k and k + 4.
ISOSTAT_INLINE Real3<Native> load_spin_difference(const double* spins, const RowOffset* i, const RowOffset* j, Native) {
  const auto both = [&](const RowOffset* o, int k) {
    return _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_load_pd(row_at<kSpinWidth>(spins, o[k]))),
                              _mm256_load_pd(row_at<kSpinWidth>(spins, o[k + 4])), 1);
  };
  __m512d r[4];
  for (int k = 0; k < 4; ++k) r[k] = _mm512_sub_pd(both(j, k), both(i, k));
  const __m512d s0 = _mm512_unpacklo_pd(r[0], r[1]), s1 = _mm512_unpackhi_pd(r[0], r[1]);
  const __m512d s2 = _mm512_unpacklo_pd(r[2], r[3]);
  const __m512d s3 = _mm512_unpackhi_pd(r[2], r[3]);
  const __m512i low = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13), high = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
  return natives(_mm512_permutex2var_pd(s0, low, s2), _mm512_permutex2var_pd(s1, low, s3),
                 _mm512_permutex2var_pd(s0, high, s2));
}

ISOSTAT_INLINE Native look_up(const double* table, const std::uint8_t* codes, Native) {
  const __m512i lanes = _mm512_cvtepu8_epi64(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(codes)));
  return Native(_mm512_i64gather_pd(lanes, table, 8));
}

ISOSTAT_INLINE void add_loads(double* loads, const RowOffset* i, const RowOffset* j, const Real3<Native>& f,
                              const Real3<Native>& a) {
  const __m512d zero = _mm512_setzero_pd();
  const __m512d columns[8] = {static_cast<__m512d>(f[0]),
                              static_cast<__m512d>(f[1]),
                              static_cast<__m512d>(f[2]),
                              static_cast<__m512d>(a[0]),
                              static_cast<__m512d>(a[1]),
                              static_cast<__m512d>(a[2]),
                              zero,
                              zero};
  const EightColumns row = transposed(columns);
  const __m512d sign = _mm512_setr_pd(-1, -1, -1, 1, 1, 1, 1, 1);
  for (int k = 0; k < 8; ++k) {
    double *on_i = row_at<kLoadWidth>(loads, i[k]), *on_j = row_at<kLoadWidth>(loads, j[k]);
    const __m512d j_now = _mm512_add_pd(_mm512_load_pd(on_j), row.c[k]);
    const __m512d i_now = _mm512_fmadd_pd(row.c[k], sign, _mm512_load_pd(on_i));
    _mm512_store_pd(on_j, j_now), _mm512_store_pd(on_i, i_now);
  }
}

// Triples to rows of four at `loads`, stride kWidth; to those of j as they are, to those of i negative.
template <int kWidth>
ISOSTAT_INLINE void add_triples(double* loads, const RowOffset* i, const RowOffset* j, const Real3<Native>& f) {
  const __m512d zero = _mm512_setzero_pd(), x = static_cast<__m512d>(f[0]), y = static_cast<__m512d>(f[1]);
  const __m512d z = static_cast<__m512d>(f[2]);
  const __m512d xy_lo = _mm512_unpacklo_pd(x, y), xy_hi = _mm512_unpackhi_pd(x, y);
  const __m512d z_lo = _mm512_unpacklo_pd(z, zero), z_hi = _mm512_unpackhi_pd(z, zero);
  const __m512i low = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13), high = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
  const __m512d p04 = _mm512_permutex2var_pd(xy_lo, low, z_lo), p26 = _mm512_permutex2var_pd(xy_lo, high, z_lo);
  const __m512d p15 = _mm512_permutex2var_pd(xy_hi, low, z_hi), p37 = _mm512_permutex2var_pd(xy_hi, high, z_hi);
  const __m256d rows[8] = {_mm512_castpd512_pd256(p04),    _mm512_castpd512_pd256(p15),
                           _mm512_castpd512_pd256(p26),    _mm512_castpd512_pd256(p37),
                           _mm512_extractf64x4_pd(p04, 1), _mm512_extractf64x4_pd(p15, 1),
                           _mm512_extractf64x4_pd(p26, 1), _mm512_extractf64x4_pd(p37, 1)};
  for (int k = 0; k < 8; ++k) {
    double *on_i = row_at<kWidth>(loads, i[k]), *on_j = row_at<kWidth>(loads, j[k]);
    const __m256d j_now = _mm256_add_pd(_mm256_load_pd(on_j), rows[k]);
    const __m256d i_now = _mm256_sub_pd(_mm256_load_pd(on_i), rows[k]);
    _mm256_store_pd(on_j, j_now), _mm256_store_pd(on_i, i_now);
  }
}
ISOSTAT_INLINE void add_forces(double* loads, const RowOffset* i, const RowOffset* j, const Real3<Native>& f) {
  add_triples<kLoadWidth>(loads, i, j, f);
}
ISOSTAT_INLINE void add_moments(double* moments, const RowOffset* i, const RowOffset* j, const Real3<Native>& m) {
  add_triples<kSpinWidth>(moments, i, j, m);
}

}  // namespace isostat::spheres
#endif
