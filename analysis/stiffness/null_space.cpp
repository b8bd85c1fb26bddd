#include "analysis/stiffness/null_space.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace isostat {
namespace {

[[noreturn]] void refuse(std::size_t vectors, std::size_t size) {
  throw std::length_error(std::to_string(vectors) + " null vectors of " + std::to_string(size) +
                          " entries are too many to store");
}

}  // namespace

NullSpace::NullSpace(std::size_t size, std::size_t dimension,
                     const std::function<std::vector<double>(std::size_t)>& vector_of)
    : start_{0} {
  for (std::size_t k = 0; k < dimension; ++k) {
    const std::vector<double> x = vector_of(k);
    for (std::size_t i = 0; i < size; ++i)
      if (x[i] != 0) row_.push_back(static_cast<std::int32_t>(i)), value_.push_back(x[i]);
    if (row_.size() > kMostEntries) refuse(dimension, size);
    start_.push_back(row_.size());
  }
  gram_.emplace(factor_gram(size));
}

SparseCholesky NullSpace::factor_gram(std::size_t size) const {
  const std::size_t dimension = start_.size() - 1;
  // N by rows, then row k of N^T N gathers the rows of N that vector k touches.
  std::vector<std::size_t> first(size + 1, 0);
  for (std::int32_t r : row_) ++first[static_cast<std::size_t>(r) + 1];
  for (std::size_t i = 0; i < size; ++i) first[i + 1] += first[i];
  std::vector<std::size_t> next(first.begin(), first.end() - 1);
  std::vector<std::int32_t> vector_at(row_.size());
  std::vector<double> value_at(row_.size());
  for (std::size_t k = 0; k < dimension; ++k)
    for (std::size_t e = start_[k]; e < start_[k + 1]; ++e) {
      const std::size_t to = next[static_cast<std::size_t>(row_[e])]++;
      vector_at[to] = static_cast<std::int32_t>(k), value_at[to] = value_[e];
    }

  SymmetricMatrix gram;
  gram.size = static_cast<std::int32_t>(dimension);
  gram.start.push_back(0);
  std::vector<double> sum(dimension, 0.0);
  std::vector<char> touched(dimension, 0);
  std::vector<std::int32_t> pattern;
  for (std::size_t k = 0; k < dimension; ++k) {
    pattern.clear();
    for (std::size_t e = start_[k]; e < start_[k + 1]; ++e) {
      const auto r = static_cast<std::size_t>(row_[e]);
      // vector_at ascends within a row: the lower triangle is its tail
      auto f = static_cast<std::size_t>(std::lower_bound(vector_at.begin() + static_cast<std::ptrdiff_t>(first[r]),
                                                         vector_at.begin() + static_cast<std::ptrdiff_t>(first[r + 1]),
                                                         static_cast<std::int32_t>(k)) -
                                        vector_at.begin());
      for (; f < first[r + 1]; ++f) {
        const auto v = static_cast<std::size_t>(vector_at[f]);
        if (!touched[v]) touched[v] = 1, pattern.push_back(vector_at[f]);
        sum[v] += value_[e] * value_at[f];
      }
    }
    std::sort(pattern.begin(), pattern.end());
    for (std::int32_t v : pattern) {
      gram.row.push_back(v), gram.value.push_back(sum[static_cast<std::size_t>(v)]);
      sum[static_cast<std::size_t>(v)] = 0, touched[static_cast<std::size_t>(v)] = 0;
    }
    if (gram.row.size() > kMostEntries) refuse(dimension, size);
    gram.start.push_back(static_cast<std::int32_t>(gram.row.size()));
  }
  return SparseCholesky(gram, SparseCholesky::Form::definite);
}

void NullSpace::project_out(std::vector<double>& x) const {
  const std::size_t dimension = start_.size() - 1;
  std::vector<double> overlap(dimension);
  for (int pass = 0; pass < 2; ++pass) {
    for (std::size_t k = 0; k < dimension; ++k) {
      double s = 0;
      for (std::size_t e = start_[k]; e < start_[k + 1]; ++e) s += value_[e] * x[static_cast<std::size_t>(row_[e])];
      overlap[k] = s;
    }
    const std::vector<double> share = gram_->solve(overlap);
    for (std::size_t k = 0; k < dimension; ++k)
      for (std::size_t e = start_[k]; e < start_[k + 1]; ++e)
        x[static_cast<std::size_t>(row_[e])] -= value_[e] * share[k];
  }
}

}  // namespace isostat
