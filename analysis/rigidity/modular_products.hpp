// The dense kernel of elimination modulo p:  A <- A - L Q,  rows of A and Q contiguous.
#pragma once
#include <cstddef>
#include <cstdint>

#include "analysis/rigidity/prime_field.hpp"

namespace isostat {

inline constexpr std::int32_t kMostTerms = 32;  // columns of L: sums of that many products are reduced once

template <class F>
struct DenseBlock {
  F* data = nullptr;
  std::ptrdiff_t stride = 0;  // from row to row
};
template <class F>
struct ConstDenseBlock {
  const F* data = nullptr;
  std::ptrdiff_t stride = 0;
};

// A (rows x columns) -= L (rows x terms) Q (terms x columns); terms <= kMostTerms, no overlap of A with L or Q.
// Where the processor has the 52-bit multiply-add (AVX-512 IFMA) and B = 52, eight residues at a time; otherwise
// subtract_products_plain(). Both give the same residues.
template <class F>
void subtract_products(DenseBlock<F> a, ConstDenseBlock<F> l, ConstDenseBlock<F> q, std::int32_t rows,
                       std::int32_t columns, std::int32_t terms);
template <class F>
void subtract_products_plain(DenseBlock<F> a, ConstDenseBlock<F> l, ConstDenseBlock<F> q, std::int32_t rows,
                             std::int32_t columns, std::int32_t terms);
bool has_vector_products();  // of this processor

}  // namespace isostat
