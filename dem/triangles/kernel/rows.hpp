// How triangles lie in memory for the overlap kernel, and how W of them are brought into lanes.
//
// A triangle is one 64-byte row  [x0, y0, x1, y1, x2, y2, -, -]  of corners, a load one 32-byte row
// [Fx, Fy, torque, -]. Pairs name triangles by their slot (dem/triangles/grain_store.hpp). Lanes write back pair by
// pair, in list order; the last number of a load is scratch.
#pragma once
#include <cstddef>
#include <cstdint>

#include "geometry/overlap_clip.hpp"

namespace isostat::kernel {

inline constexpr std::size_t kCornerRow = 8, kLoadRow = 4;  // doubles
inline constexpr std::size_t kLanes = 8;                    // of a pack and of a block, whatever the instruction set

ISOSTAT_INLINE TriangleLanes<Scalar> load_triangles(const double* rows, const std::uint32_t* slot, Scalar) {
  const double* r = rows + kCornerRow * *slot;
  return {{r[0], r[2], r[4]}, {r[1], r[3], r[5]}};
}

// f = [fx, fy, moment of A, moment of B] of the force on A.
ISOSTAT_INLINE void add_pair_load(double* loads, std::uint32_t a, std::uint32_t b, const double* f) {
  double *on_a = loads + kLoadRow * a, *on_b = loads + kLoadRow * b;
  on_a[0] += f[0], on_a[1] += f[1], on_a[2] += f[2];
  on_b[0] -= f[0], on_b[1] -= f[1], on_b[2] += f[3];
}
ISOSTAT_INLINE void add_pair_loads(double* loads, const std::uint32_t* a, const std::uint32_t* b, Scalar fx, Scalar fy,
                                   Scalar moment_a, Scalar moment_b) {
  const double f[4] = {fx[0], fy[0], moment_a[0], moment_b[0]};
  add_pair_load(loads, *a, *b, f);
}

#if defined(__AVX2__)
ISOSTAT_INLINE void add_pair_load(double* loads, std::uint32_t a, std::uint32_t b, __m256d f) {
  double *on_a = loads + kLoadRow * std::size_t{a}, *on_b = loads + kLoadRow * std::size_t{b};
  const __m256d to_b = _mm256_permute_pd(f, 0b0110);  // fx, fy, moment of B, moment of A
  const __m256d a_now = _mm256_add_pd(_mm256_load_pd(on_a), f);
  _mm256_store_pd(on_a, a_now);
  const __m256d b_now = _mm256_fmadd_pd(to_b, _mm256_setr_pd(-1, -1, 1, 1), _mm256_load_pd(on_b));
  _mm256_store_pd(on_b, b_now);
}
#endif

#if defined(__AVX512F__)
ISOSTAT_INLINE TriangleLanes<Native> load_triangles(const double* rows, const std::uint32_t* slot, Native) {
  __m512d r[8], s[8], t[8];
  for (int k = 0; k < 8; ++k) r[k] = _mm512_load_pd(rows + kCornerRow * std::size_t{slot[k]});
  for (int k = 0; k < 8; k += 2) {
    s[k] = _mm512_unpacklo_pd(r[k], r[k + 1]);
    s[k + 1] = _mm512_unpackhi_pd(r[k], r[k + 1]);
  }
  for (int k = 0; k < 8; k += 4)
    for (int h = 0; h < 2; ++h) {
      t[k + h] = _mm512_shuffle_f64x2(s[k + h], s[k + h + 2], 0x88);
      t[k + h + 2] = _mm512_shuffle_f64x2(s[k + h], s[k + h + 2], 0xdd);
    }
  // t[0], t[4]: columns 0 and 4 of rows 0-3 and 4-7; t[2], t[6]: columns 2 and 6; t[1], t[3]: the odd ones.
  const auto low = [&](int k) { return Native(_mm512_shuffle_f64x2(t[k], t[k + 4], 0x88)); };
  const auto high = [&](int k) { return Native(_mm512_shuffle_f64x2(t[k], t[k + 4], 0xdd)); };
  return {{low(0), low(2), high(0)}, {low(1), low(3), high(1)}};
}
ISOSTAT_INLINE void add_pair_loads(double* loads, const std::uint32_t* a, const std::uint32_t* b, Native fx, Native fy,
                                   Native moment_a, Native moment_b) {
  const __m512d xy_lo = _mm512_unpacklo_pd(static_cast<__m512d>(fx), static_cast<__m512d>(fy));
  const __m512d xy_hi = _mm512_unpackhi_pd(static_cast<__m512d>(fx), static_cast<__m512d>(fy));
  const __m512d m_lo = _mm512_unpacklo_pd(static_cast<__m512d>(moment_a), static_cast<__m512d>(moment_b));
  const __m512d m_hi = _mm512_unpackhi_pd(static_cast<__m512d>(moment_a), static_cast<__m512d>(moment_b));
  const __m512i lower = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13);
  const __m512i upper = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
  const __m512d p04 = _mm512_permutex2var_pd(xy_lo, lower, m_lo), p26 = _mm512_permutex2var_pd(xy_lo, upper, m_lo);
  const __m512d p15 = _mm512_permutex2var_pd(xy_hi, lower, m_hi), p37 = _mm512_permutex2var_pd(xy_hi, upper, m_hi);
  add_pair_load(loads, a[0], b[0], _mm512_castpd512_pd256(p04));
  add_pair_load(loads, a[1], b[1], _mm512_castpd512_pd256(p15));
  add_pair_load(loads, a[2], b[2], _mm512_castpd512_pd256(p26));
  add_pair_load(loads, a[3], b[3], _mm512_castpd512_pd256(p37));
  add_pair_load(loads, a[4], b[4], _mm512_extractf64x4_pd(p04, 1));
  add_pair_load(loads, a[5], b[5], _mm512_extractf64x4_pd(p15, 1));
  add_pair_load(loads, a[6], b[6], _mm512_extractf64x4_pd(p26, 1));
  add_pair_load(loads, a[7], b[7], _mm512_extractf64x4_pd(p37, 1));
}
#elif defined(__AVX2__)
struct FourLanes {
  Native c0, c1, c2, c3;
};
ISOSTAT_INLINE FourLanes transpose_lanes(const __m256d r[4]) {
  const __m256d s0 = _mm256_unpacklo_pd(r[0], r[1]), s1 = _mm256_unpackhi_pd(r[0], r[1]);
  const __m256d s2 = _mm256_unpacklo_pd(r[2], r[3]), s3 = _mm256_unpackhi_pd(r[2], r[3]);
  return {Native(_mm256_permute2f128_pd(s0, s2, 0x20)), Native(_mm256_permute2f128_pd(s1, s3, 0x20)),
          Native(_mm256_permute2f128_pd(s0, s2, 0x31)), Native(_mm256_permute2f128_pd(s1, s3, 0x31))};
}
ISOSTAT_INLINE TriangleLanes<Native> load_triangles(const double* rows, const std::uint32_t* slot, Native) {
  __m256d low[4], high[4];
  for (int k = 0; k < 4; ++k) {
    const double* r = rows + kCornerRow * std::size_t{slot[k]};
    low[k] = _mm256_load_pd(r), high[k] = _mm256_load_pd(r + 4);
  }
  const FourLanes l = transpose_lanes(low), h = transpose_lanes(high);
  return {{l.c0, l.c2, h.c0}, {l.c1, l.c3, h.c1}};
}
ISOSTAT_INLINE void add_pair_loads(double* loads, const std::uint32_t* a, const std::uint32_t* b, Native fx, Native fy,
                                   Native moment_a, Native moment_b) {
  const __m256d columns[4] = {static_cast<__m256d>(fx), static_cast<__m256d>(fy), static_cast<__m256d>(moment_a),
                              static_cast<__m256d>(moment_b)};
  const FourLanes f = transpose_lanes(columns);
  add_pair_load(loads, a[0], b[0], static_cast<__m256d>(f.c0));
  add_pair_load(loads, a[1], b[1], static_cast<__m256d>(f.c1));
  add_pair_load(loads, a[2], b[2], static_cast<__m256d>(f.c2));
  add_pair_load(loads, a[3], b[3], static_cast<__m256d>(f.c3));
}
#endif

}  // namespace isostat::kernel
