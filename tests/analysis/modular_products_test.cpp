// The dense kernel of elimination modulo p: the vector way and the plain way against integers of 128 bits.
#include "analysis/rigidity/modular_products.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "analysis/rigidity/modular_front.hpp"

namespace isostat {
namespace {

template <class F>
std::vector<F> residues(std::size_t n, std::uint64_t seed) {
  std::vector<F> v(n);
  for (std::size_t k = 0; k < n; ++k)
    v[k] = k % 5 == 0 ? F(F::kPrime - 1) : k % 11 == 0 ? F{} : F::random(seed, k);  // extremes among them
  return v;
}

template <class F>
void expect_products(std::int32_t rows, std::int32_t columns, std::int32_t terms) {
  using Multiply =
      void (*)(DenseBlock<F>, ConstDenseBlock<F>, ConstDenseBlock<F>, std::int32_t, std::int32_t, std::int32_t);
  const std::ptrdiff_t a_stride = columns + 3, l_stride = terms + 1, q_stride = columns + 2;
  const auto size = [](std::ptrdiff_t stride, std::int32_t n) { return static_cast<std::size_t>(stride * n); };
  const auto l = residues<F>(size(l_stride, rows), 1), q = residues<F>(size(q_stride, terms) + 1, 2);
  const auto before = residues<F>(size(a_stride, rows), 3);
  for (const Multiply multiply : {Multiply{subtract_products<F>}, Multiply{subtract_products_plain<F>}}) {
    auto a = before;
    multiply({a.data(), a_stride}, {l.data(), l_stride}, {q.data(), q_stride}, rows, columns, terms);
    for (std::int32_t i = 0; i < rows; ++i)
      for (std::int32_t j = 0; j < a_stride; ++j) {
        const auto at = static_cast<std::size_t>(i * a_stride + j);
        Wide expected = before[at].value;
        for (std::int32_t t = 0; t < terms && j < columns; ++t) {
          const Wide product = static_cast<Wide>(l[static_cast<std::size_t>(i * l_stride + t)].value) *
                               q[static_cast<std::size_t>(t * q_stride + j)].value;
          expected = (expected + F::kPrime - static_cast<std::uint64_t>(product % F::kPrime)) % F::kPrime;
        }
        ASSERT_EQ(a[at].value, static_cast<std::uint64_t>(expected)) << rows << 'x' << columns << 'x' << terms;
      }
  }
}

template <class F>
class ModularProducts : public testing::Test {};
using Fields = testing::Types<FirstField, SecondField, WideField>;
TYPED_TEST_SUITE(ModularProducts, Fields);

TYPED_TEST(ModularProducts, EqualIntegers) {
  for (const std::int32_t rows : {1, 3, 4, 9})
    for (const std::int32_t columns : {1, 7, 8, 9, 16, 17, 40})
      for (const std::int32_t terms : {1, 2, 31, kMostTerms}) expect_products<TypeParam>(rows, columns, terms);
}

TYPED_TEST(ModularProducts, InverseOfEveryKind) {
  using F = TypeParam;
  EXPECT_TRUE(F{}.inverse().is_zero());
  for (std::uint64_t k = 0; k < 2000; ++k) {
    const F x = k < 1000 ? F::random(5, k) : F(k < 1500 ? k - 999 : F::kPrime - (k - 1499));
    EXPECT_EQ((x * x.inverse()).value, 1u) << x.value;
  }
}

// A front of random rank: L D L^T gives the matrix back, its Schur complement is what is left, zero pivots are counted.
TYPED_TEST(ModularProducts, FrontFactorises) {
  using F = TypeParam;
  for (const std::int32_t size : {1, 5, 37, 90}) {
    const std::int32_t pivots = size == 1 ? 1 : 2 * size / 3 + 1, rank = size == 1 ? 1 : pivots - 3;
    // A = sum over `rank` rows g of w g g^T
    std::vector<std::vector<F>> a(static_cast<std::size_t>(size), std::vector<F>(static_cast<std::size_t>(size)));
    ModularFront<F> front;
    front.reset(size);
    for (std::int32_t k = 0; k < rank; ++k) {
      std::vector<F> g(static_cast<std::size_t>(size));
      for (std::size_t i = 0; i < g.size(); ++i) g[i] = F::random(100 + static_cast<std::uint64_t>(k), i);
      const F w = F::random(9, static_cast<std::uint64_t>(k));
      for (std::int32_t i = 0; i < size; ++i)
        for (std::int32_t j = 0; j <= i; ++j) {
          const auto u = static_cast<std::size_t>(i), v = static_cast<std::size_t>(j);
          a[u][v] = a[u][v] + w * g[u] * g[v];
          front.add(i, j, w * g[u] * g[v]);
        }
    }
    std::vector<F> inverse;
    EXPECT_EQ(front.eliminate(pivots, inverse), rank);
    for (std::int32_t i = 0; i < size; ++i)
      for (std::int32_t j = 0; j <= i; ++j) {
        F sum = j >= pivots ? front.row(i)[j] : F{};
        for (std::int32_t k = 0; k < std::min(j + 1, pivots); ++k) {
          const F d = inverse[static_cast<std::size_t>(k)].inverse();
          sum = sum + (k == i ? F(1) : front.row(i)[k]) * d * (k == j ? F(1) : front.row(j)[k]);
        }
        ASSERT_EQ(sum, a[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)]) << size << ' ' << i << ' ' << j;
      }
  }
}

}  // namespace
}  // namespace isostat
