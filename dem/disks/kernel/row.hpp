// How bodies lie in memory for the force kernels, and how W of them are brought into registers.
//
// A body is one 64-byte row  [x, y, u, v, R w, w, p, q]:  position, half-step velocity, half-step surface speed and
// spin, predicted full-step velocity. A pair needs the differences of the rows of j and i, but the sum of the surface
// speeds, so  j + sign * i  in one fused operation a row and one W x W transpose bring a batch of W pairs into lanes.
// A body's load is one 32-byte row  [Fx, Fy, A, B]:  force, and the moment as R A + B (lever arms are proportional to
// R, see dem/state/link.hpp). Lanes write back pair by pair, in list order: the sum on a body is the same whatever W
// is.
#pragma once
#include <cstdint>

#include "dem/disks/kernel/twin.hpp"
#include "dem/state/link.hpp"
#include "geometry/base/lanes.hpp"

namespace isostat::kernel {

inline constexpr int kRowWidth = 8, kLoadWidth = 4;  // doubles
// Their places by name, for those who write or read a row one number at a time.
struct Slot {
  enum : std::uint8_t { x, y, half_vx, half_vy, surface_speed, half_spin, vx, vy };
};
struct LoadSlot {
  enum : std::uint8_t { fx, fy, moment_per_radius, moment };  // moment on the body = R A + B
};

// Pairs name bodies by the offset of their row in doubles: body k is at rows[8 k] and loads[4 k], addresses that cost
// one load and no arithmetic.
using RowOffset = std::uint32_t;
ISOSTAT_INLINE const double* row_at(const double* rows, RowOffset o) { return rows + std::size_t{o}; }
ISOSTAT_INLINE double* load_at(double* loads, RowOffset o) {
  return reinterpret_cast<double*>(reinterpret_cast<char*>(loads) +
                                   std::size_t{o} * (kLoadWidth * sizeof(double) / kRowWidth));
}

template <class V>
struct PairDifference {
  V x, y, u, v, surface_sum, spin, p, q;  // j minus i; surface_sum is R_i w_i + R_j w_j
};

ISOSTAT_INLINE PairDifference<Scalar> load_differences(const double* rows, const RowOffset* i, const RowOffset* j,
                                                       Scalar) {
  const double* a = row_at(rows, *i);
  const double* b = row_at(rows, *j);
  return {b[0] - a[0], b[1] - a[1], b[2] - a[2], b[3] - a[3], b[4] + a[4], b[5] - a[5], b[6] - a[6], b[7] - a[7]};
}

// table[codes[lane]]; a table has 16 entries, so that two AVX-512 registers hold it.
ISOSTAT_INLINE Scalar look_up(const double* table, const std::uint8_t* codes, Scalar) { return Scalar(table[*codes]); }

ISOSTAT_INLINE void add_loads(double* loads, const RowOffset* i, const RowOffset* j, Scalar fx, Scalar fy, Scalar a,
                              Scalar b) {
  double* on_i = load_at(loads, *i);
  double* on_j = load_at(loads, *j);
  on_i[0] -= fx[0], on_i[1] -= fy[0], on_i[2] += a[0], on_i[3] -= b[0];
  on_j[0] += fx[0], on_j[1] += fy[0], on_j[2] += a[0], on_j[3] += b[0];
}

#if defined(__AVX2__)
ISOSTAT_INLINE void add_load_pair(double* loads, RowOffset i, RowOffset j, __m256d f) {
  const __m256d sign = _mm256_setr_pd(-1, -1, 1, -1);
  double* on_i = load_at(loads, i);
  double* on_j = load_at(loads, j);
  const __m256d j_now = _mm256_add_pd(_mm256_load_pd(on_j), f);
  const __m256d i_now = _mm256_fmadd_pd(f, sign, _mm256_load_pd(on_i));
  _mm256_store_pd(on_j, j_now);
  _mm256_store_pd(on_i, i_now);
}
#endif

#if defined(__AVX512F__)
ISOSTAT_INLINE PairDifference<Native> load_differences(const double* rows, const RowOffset* i, const RowOffset* j,
                                                       Native) {
  const __m512d sign = _mm512_setr_pd(-1, -1, -1, -1, 1, -1, -1, -1);
  __m512d r[8];
  for (int k = 0; k < 8; ++k) {
    const __m512d a = _mm512_load_pd(row_at(rows, i[k]));
    const __m512d b = _mm512_load_pd(row_at(rows, j[k]));
    r[k] = _mm512_fmadd_pd(a, sign, b);
  }
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
  auto even = [&](int k) { return Native(_mm512_shuffle_f64x2(t[k], t[k + 4], 0x88)); };
  auto odd = [&](int k) { return Native(_mm512_shuffle_f64x2(t[k], t[k + 4], 0xdd)); };
  return {even(0), even(1), even(2), even(3), odd(0), odd(1), odd(2), odd(3)};
}

ISOSTAT_INLINE Native look_up(const double* table, const std::uint8_t* codes, Native) {
  const __m512i lanes = _mm512_cvtepu8_epi64(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(codes)));
  return Native(_mm512_permutex2var_pd(_mm512_loadu_pd(table), lanes, _mm512_loadu_pd(table + 8)));
}

ISOSTAT_INLINE void add_loads(double* loads, const RowOffset* i, const RowOffset* j, Native fx, Native fy, Native a,
                              Native b) {
  const __m512d xy_lo = _mm512_unpacklo_pd(static_cast<__m512d>(fx), static_cast<__m512d>(fy));
  const __m512d xy_hi = _mm512_unpackhi_pd(static_cast<__m512d>(fx), static_cast<__m512d>(fy));
  const __m512d ab_lo = _mm512_unpacklo_pd(static_cast<__m512d>(a), static_cast<__m512d>(b));
  const __m512d ab_hi = _mm512_unpackhi_pd(static_cast<__m512d>(a), static_cast<__m512d>(b));
  const __m512i lower = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13);
  const __m512i upper = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
  const __m512d p04 = _mm512_permutex2var_pd(xy_lo, lower, ab_lo), p26 = _mm512_permutex2var_pd(xy_lo, upper, ab_lo);
  const __m512d p15 = _mm512_permutex2var_pd(xy_hi, lower, ab_hi), p37 = _mm512_permutex2var_pd(xy_hi, upper, ab_hi);
  add_load_pair(loads, i[0], j[0], _mm512_castpd512_pd256(p04));
  add_load_pair(loads, i[1], j[1], _mm512_castpd512_pd256(p15));
  add_load_pair(loads, i[2], j[2], _mm512_castpd512_pd256(p26));
  add_load_pair(loads, i[3], j[3], _mm512_castpd512_pd256(p37));
  add_load_pair(loads, i[4], j[4], _mm512_extractf64x4_pd(p04, 1));
  add_load_pair(loads, i[5], j[5], _mm512_extractf64x4_pd(p15, 1));
  add_load_pair(loads, i[6], j[6], _mm512_extractf64x4_pd(p26, 1));
  add_load_pair(loads, i[7], j[7], _mm512_extractf64x4_pd(p37, 1));
}

#elif defined(__AVX2__)
struct FourColumns {
  Native c0, c1, c2, c3;
};
ISOSTAT_INLINE FourColumns transpose(const __m256d r[4]) {
  const __m256d s0 = _mm256_unpacklo_pd(r[0], r[1]), s1 = _mm256_unpackhi_pd(r[0], r[1]);
  const __m256d s2 = _mm256_unpacklo_pd(r[2], r[3]), s3 = _mm256_unpackhi_pd(r[2], r[3]);
  return {Native(_mm256_permute2f128_pd(s0, s2, 0x20)), Native(_mm256_permute2f128_pd(s1, s3, 0x20)),
          Native(_mm256_permute2f128_pd(s0, s2, 0x31)), Native(_mm256_permute2f128_pd(s1, s3, 0x31))};
}

ISOSTAT_INLINE PairDifference<Native> load_differences(const double* rows, const RowOffset* i, const RowOffset* j,
                                                       Native) {
  const __m256d sign = _mm256_setr_pd(1, -1, -1, -1);
  __m256d lo[4], hi[4];
  for (int k = 0; k < 4; ++k) {
    const double* a = row_at(rows, i[k]);
    const double* b = row_at(rows, j[k]);
    lo[k] = _mm256_sub_pd(_mm256_load_pd(b), _mm256_load_pd(a));
    hi[k] = _mm256_fmadd_pd(_mm256_load_pd(a + 4), sign, _mm256_load_pd(b + 4));
  }
  const FourColumns l = transpose(lo), h = transpose(hi);
  return {l.c0, l.c1, l.c2, l.c3, h.c0, h.c1, h.c2, h.c3};
}

ISOSTAT_INLINE Native look_up(const double* table, const std::uint8_t* codes, Native) {
  return Native(_mm256_setr_pd(table[codes[0]], table[codes[1]], table[codes[2]], table[codes[3]]));
}

ISOSTAT_INLINE void add_loads(double* loads, const RowOffset* i, const RowOffset* j, Native fx, Native fy, Native a,
                              Native b) {
  const __m256d columns[4] = {static_cast<__m256d>(fx), static_cast<__m256d>(fy), static_cast<__m256d>(a),
                              static_cast<__m256d>(b)};
  const FourColumns f = transpose(columns);
  add_load_pair(loads, i[0], j[0], static_cast<__m256d>(f.c0));
  add_load_pair(loads, i[1], j[1], static_cast<__m256d>(f.c1));
  add_load_pair(loads, i[2], j[2], static_cast<__m256d>(f.c2));
  add_load_pair(loads, i[3], j[3], static_cast<__m256d>(f.c3));
}
#endif

// Two batches side by side.
template <class V>
ISOSTAT_INLINE PairDifference<Twin<V>> load_differences(const double* rows, const RowOffset* i, const RowOffset* j,
                                                        Twin<V>) {
  const PairDifference<V> a = load_differences(rows, i, j, V());
  const PairDifference<V> b = load_differences(rows, i + V::size(), j + V::size(), V());
  return {{a.x, b.x},       {a.y, b.y}, {a.u, b.u}, {a.v, b.v}, {a.surface_sum, b.surface_sum},
          {a.spin, b.spin}, {a.p, b.p}, {a.q, b.q}};
}
template <class V>
ISOSTAT_INLINE Twin<V> look_up(const double* table, const std::uint8_t* codes, Twin<V>) {
  return {look_up(table, codes, V()), look_up(table, codes + V::size(), V())};
}
template <class V>
ISOSTAT_INLINE void add_loads(double* loads, const RowOffset* i, const RowOffset* j, const Twin<V>& fx,
                              const Twin<V>& fy, const Twin<V>& a, const Twin<V>& b) {
  add_loads(loads, i, j, fx.a, fy.a, a.a, b.a);
  add_loads(loads, i + V::size(), j + V::size(), fx.b, fy.b, a.b, b.b);
}

}  // namespace isostat::kernel
