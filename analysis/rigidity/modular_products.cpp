#include "analysis/rigidity/modular_products.hpp"

#include <algorithm>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace isostat {

template <class F>
void subtract_products_plain(DenseBlock<F> a, ConstDenseBlock<F> l, ConstDenseBlock<F> q, std::int32_t rows,
                             std::int32_t columns, std::int32_t terms) {
  static_assert(kMostTerms < F::kDeferred);
  for (std::int32_t i = 0; i < rows; ++i) {
    F* target = a.data + i * a.stride;
    const F* factor = l.data + i * l.stride;
    std::int32_t j = 0;
    for (; j + 4 <= columns; j += 4) {
      Wide s0 = 0, s1 = 0, s2 = 0, s3 = 0;
      const F* from = q.data + j;
      for (std::int32_t t = 0; t < terms; ++t, from += q.stride) {
        const auto x = static_cast<Wide>(factor[t].value);
        s0 += x * from[0].value, s1 += x * from[1].value, s2 += x * from[2].value, s3 += x * from[3].value;
      }
      target[j] = target[j] - F(F::reduce(s0)), target[j + 1] = target[j + 1] - F(F::reduce(s1));
      target[j + 2] = target[j + 2] - F(F::reduce(s2)), target[j + 3] = target[j + 3] - F(F::reduce(s3));
    }
    for (; j < columns; ++j) {
      Wide s = 0;
      for (std::int32_t t = 0; t < terms; ++t) s += static_cast<Wide>(factor[t].value) * q.data[t * q.stride + j].value;
      target[j] = target[j] - F(F::reduce(s));
    }
  }
}

#if defined(__x86_64__)

bool has_vector_products() {
  static const bool has =
      __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512ifma");
  return has;
}

namespace {

#define ISOSTAT_IFMA __attribute__((target("avx512f,avx512dq,avx512ifma")))

struct Modulus {
  __m512i prime, mask, complement;
};

// a - (low + 2^52 high) mod p, for sums of at most 32 low and high halves: low, high < 2^57.
ISOSTAT_IFMA inline __m512i subtracted(__m512i a, __m512i low, __m512i high, const Modulus& m) {
  // 2^52 = C: the top of high comes down as C (< 2^13), then high as C high < 2^61.
  high = _mm512_madd52lo_epu64(_mm512_and_si512(high, m.mask), _mm512_srli_epi64(high, 52), m.complement);
  __m512i s = _mm512_add_epi64(low, _mm512_mullo_epi64(high, m.complement));
  s = _mm512_madd52lo_epu64(_mm512_and_si512(s, m.mask), _mm512_srli_epi64(s, 52), m.complement);  // < 2^52 + 2^17
  s = _mm512_min_epu64(s, _mm512_sub_epi64(s, m.prime));  // wraps to a huge number where s < p
  const __m512i d = _mm512_sub_epi64(a, s);
  return _mm512_min_epu64(d, _mm512_add_epi64(d, m.prime));
}

// R rows by V vectors of eight columns, the last vector under `tail`.
template <int R, int V>
ISOSTAT_IFMA inline void tile(std::uint64_t* a, std::ptrdiff_t a_stride, const std::uint64_t* l,
                              std::ptrdiff_t l_stride, const std::uint64_t* q, std::ptrdiff_t q_stride,
                              std::int32_t terms, __mmask8 tail, const Modulus& m) {
  __m512i low[R][V], high[R][V];
  for (int r = 0; r < R; ++r)
    for (int v = 0; v < V; ++v) low[r][v] = high[r][v] = _mm512_setzero_si512();
  for (std::int32_t t = 0; t < terms; ++t, q += q_stride) {
    __m512i from[V];
    for (int v = 0; v < V; ++v) from[v] = _mm512_maskz_loadu_epi64(v + 1 == V ? tail : 0xFF, q + 8 * v);
    for (int r = 0; r < R; ++r) {
      const __m512i factor = _mm512_set1_epi64(static_cast<long long>(l[r * l_stride + t]));
      for (int v = 0; v < V; ++v) {
        low[r][v] = _mm512_madd52lo_epu64(low[r][v], factor, from[v]);
        high[r][v] = _mm512_madd52hi_epu64(high[r][v], factor, from[v]);
      }
    }
  }
  for (int r = 0; r < R; ++r)
    for (int v = 0; v < V; ++v) {
      const __mmask8 mask = v + 1 == V ? tail : 0xFF;
      std::uint64_t* at = a + r * a_stride + 8 * v;
      _mm512_mask_storeu_epi64(at, mask, subtracted(_mm512_maskz_loadu_epi64(mask, at), low[r][v], high[r][v], m));
    }
}

template <int R>
ISOSTAT_IFMA inline void strip(std::uint64_t* a, std::ptrdiff_t a_stride, const std::uint64_t* l,
                               std::ptrdiff_t l_stride, const std::uint64_t* q, std::ptrdiff_t q_stride,
                               std::int32_t width, std::int32_t terms, const Modulus& m) {
  const auto tail = static_cast<__mmask8>(0xFFu >> (width % 8 == 0 ? 0 : 8 - width % 8));
  if (width > 8)
    tile<R, 2>(a, a_stride, l, l_stride, q, q_stride, terms, tail, m);
  else
    tile<R, 1>(a, a_stride, l, l_stride, q, q_stride, terms, tail, m);
}

ISOSTAT_IFMA void subtract_products_ifma(std::uint64_t* a, std::ptrdiff_t a_stride, const std::uint64_t* l,
                                         std::ptrdiff_t l_stride, const std::uint64_t* q, std::ptrdiff_t q_stride,
                                         std::int32_t rows, std::int32_t columns, std::int32_t terms,
                                         std::uint64_t prime, std::uint64_t complement) {
  const Modulus m = {_mm512_set1_epi64(static_cast<long long>(prime)), _mm512_set1_epi64((1LL << 52) - 1),
                     _mm512_set1_epi64(static_cast<long long>(complement))};
  for (std::int32_t j = 0; j < columns; j += 16) {
    const std::int32_t width = std::min(16, columns - j);
    std::int32_t i = 0;
    for (; i + 4 <= rows; i += 4)
      strip<4>(a + i * a_stride + j, a_stride, l + i * l_stride, l_stride, q + j, q_stride, width, terms, m);
    for (; i < rows; ++i)
      strip<1>(a + i * a_stride + j, a_stride, l + i * l_stride, l_stride, q + j, q_stride, width, terms, m);
  }
}

#undef ISOSTAT_IFMA

}  // namespace

template <class F>
void subtract_products(DenseBlock<F> a, ConstDenseBlock<F> l, ConstDenseBlock<F> q, std::int32_t rows,
                       std::int32_t columns, std::int32_t terms) {
  static_assert(sizeof(F) == sizeof(std::uint64_t));
  if constexpr (F::kBits == 52)
    if (has_vector_products()) {
      if (rows > 0 && columns > 0 && terms > 0)
        subtract_products_ifma(&a.data->value, a.stride, &l.data->value, l.stride, &q.data->value, q.stride, rows,
                               columns, terms, F::kPrime, F::kComplement);
      return;
    }
  subtract_products_plain(a, l, q, rows, columns, terms);
}

#else

bool has_vector_products() { return false; }

template <class F>
void subtract_products(DenseBlock<F> a, ConstDenseBlock<F> l, ConstDenseBlock<F> q, std::int32_t rows,
                       std::int32_t columns, std::int32_t terms) {
  subtract_products_plain(a, l, q, rows, columns, terms);
}

#endif

#define ISOSTAT_INSTANCE(F)                                                                                          \
  template void subtract_products(DenseBlock<F>, ConstDenseBlock<F>, ConstDenseBlock<F>, std::int32_t, std::int32_t, \
                                  std::int32_t);                                                                     \
  template void subtract_products_plain(DenseBlock<F>, ConstDenseBlock<F>, ConstDenseBlock<F>, std::int32_t,         \
                                        std::int32_t, std::int32_t);
ISOSTAT_INSTANCE(FirstField)
ISOSTAT_INSTANCE(SecondField)
ISOSTAT_INSTANCE(WideField)

}  // namespace isostat
