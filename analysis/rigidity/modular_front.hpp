// A dense front of the multifrontal elimination modulo p: lower triangle by rows, its first columns fully summed.
#pragma once
#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "analysis/rigidity/modular_products.hpp"
#include "geometry/base/index.hpp"

namespace isostat {

class RandomizationFailed : public std::runtime_error {
 public:
  RandomizationFailed() : std::runtime_error("a zero pivot with a nonzero column: draw other weights") {}
};

template <class F>
class ModularFront {
 public:
  void reset(std::int32_t size) {
    size_ = size;
    a_.resize(square());
    for (std::int32_t i = 0; i < size; ++i) std::fill_n(row(i), i + 1, F{});
  }
  std::int32_t size() const { return size_; }
  F* row(std::int32_t i) { return a_.data() + static_cast<std::ptrdiff_t>(i) * size_; }
  void add(std::int32_t i, std::int32_t j, F v) {
    F& target = i >= j ? row(i)[j] : row(j)[i];
    target = target + v;
  }

  // Eliminates the first `pivots` columns; the strict lower triangle of them becomes L, the trailing triangle the Schur
  // complement (what lies above the diagonal is scratch). inverse[k] = 1 / D_k, 0 for a dependent column. Returns the
  // number of nonzero pivots. Throws RandomizationFailed.
  std::int32_t eliminate(std::int32_t pivots, std::vector<F>& inverse) {
    std::int32_t rank = 0;
    inverse.assign(static_cast<std::size_t>(pivots), F{});
    for (std::int32_t first = 0; first < pivots; first += kPanel) {
      const std::int32_t width = std::min(kPanel, pivots - first);
      rank += factor_panel(first, width, inverse);
      update_trailing(first, width);
    }
    return rank;
  }

 private:
  static constexpr std::int32_t kPanel = kMostTerms, kRows = 32;

  std::size_t square() const { return static_cast<std::size_t>(size_) * static_cast<std::size_t>(size_); }

  // Columns [first, first + width), copied to rows of `panel_`; `scaled_` receives D L. Both start at row `first`.
  std::int32_t factor_panel(std::int32_t first, std::int32_t width, std::vector<F>& inverse) {
    const std::int32_t length = size_ - first;
    const auto stride = static_cast<std::ptrdiff_t>(length);
    panel_.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(length));
    scaled_.assign(panel_.size(), F{});
    for (std::int32_t i = 0; i < length; ++i)
      for (std::int32_t k = 0; k < std::min(width, i + 1); ++k) panel_[at(k, stride, i)] = row(first + i)[first + k];

    std::int32_t rank = 0;
    F factor[kPanel];
    for (std::int32_t k = 0; k < width; ++k) {
      F* column = panel_.data() + at(k, stride, 0);
      for (std::int32_t t = 0; t < k; ++t) factor[t] = scaled_[at(t, stride, k)];
      subtract_products<F>({column + k, stride}, {factor, kPanel}, {panel_.data() + k, stride}, 1, length - k, k);
      const F d = column[k];
      if (d.is_zero()) {
        if (std::any_of(column + k, column + length, [](F x) { return !x.is_zero(); })) throw RandomizationFailed();
        continue;
      }
      ++rank;
      inverse[idx(first + k)] = d.inverse();
      const F minus = -inverse[idx(first + k)];
      F* kept = scaled_.data() + at(k, stride, 0);
      std::copy(column + k + 1, column + length, kept + k + 1);
      std::fill(column + k + 1, column + length, F{});
      subtract_products<F>({column + k + 1, stride}, {&minus, 1}, {kept + k + 1, stride}, 1, length - k - 1, 1);
    }
    for (std::int32_t i = 1; i < length; ++i)
      for (std::int32_t k = 0; k < std::min(width, i); ++k) row(first + i)[first + k] = panel_[at(k, stride, i)];
    return rank;
  }

  // A_ij -= sum over the panel of L_it (D L)_jt, by strips of rows up to the diagonal.
  void update_trailing(std::int32_t first, std::int32_t width) {
    const std::int32_t begin = first + width;
    const std::ptrdiff_t stride = size_ - first;
    for (std::int32_t i = begin; i < size_; i += kRows) {
      const std::int32_t end = std::min(i + kRows, size_);
      const ConstDenseBlock<F> q = {scaled_.data() + width, stride};
      if (i > begin)
        subtract_products<F>({row(i) + begin, size_}, {row(i) + first, size_}, q, end - i, i - begin, width);
      for (std::int32_t r = i; r < end; r += 4) {  // the triangle at the diagonal
        const std::int32_t stop = std::min(r + 4, end);
        subtract_products<F>({row(r) + i, size_}, {row(r) + first, size_}, {q.data + (i - begin), stride}, stop - r,
                             stop - i, width);
      }
    }
  }

  static std::size_t at(std::int32_t k, std::ptrdiff_t stride, std::int32_t i) {
    return static_cast<std::size_t>(k * stride + i);
  }

  std::int32_t size_ = 0;
  std::vector<F> a_, panel_, scaled_;
};

}  // namespace isostat
