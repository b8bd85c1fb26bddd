#include "analysis/rigidity/modular_ldlt.hpp"

#include <algorithm>

namespace isostat {
namespace {

constexpr std::int32_t kPanel = 32;  // pivots in a panel: a dot product over one stays below F::kDeferred terms

// A front: dense lower triangle, row i at a[i * size], its first `pivots` columns are fully summed.
template <class F>
class Front {
 public:
  void reset(std::int32_t size) {
    size_ = size;
    a_.assign(static_cast<std::size_t>(size) * static_cast<std::size_t>(size), F{});
  }
  F* row(std::int32_t i) { return a_.data() + static_cast<std::size_t>(i) * static_cast<std::size_t>(size_); }
  std::int32_t size() const { return size_; }
  void add(std::int32_t i, std::int32_t j, F v) {
    F& target = i >= j ? row(i)[j] : row(j)[i];
    target = target + v;
  }

  // Eliminates the first `pivots` columns; the strict lower triangle of them becomes L, the trailing triangle the Schur
  // complement. inverse[k] = 1 / D_k, 0 for a dependent column. Returns the number of nonzero pivots.
  std::int32_t eliminate(std::int32_t pivots, std::vector<F>& inverse) {
    std::int32_t rank = 0;
    inverse.assign(static_cast<std::size_t>(pivots), F{});
    for (std::int32_t p0 = 0; p0 < pivots; p0 += kPanel) {
      const std::int32_t p1 = std::min(p0 + kPanel, pivots), width = p1 - p0;
      scaled_.assign(static_cast<std::size_t>(size_) * kPanel, F{});  // D L of this panel
      for (std::int32_t k = p0; k < p1; ++k) {
        const std::int32_t done = k - p0;
        const F* qk = scaled(k);
        for (std::int32_t i = k; i < size_; ++i) {
          F* r = row(i);
          r[k] = r[k] - dot(r + p0, qk, done);
        }
        const F d = row(k)[k];
        if (d.is_zero()) {
          for (std::int32_t i = k + 1; i < size_; ++i)
            if (!row(i)[k].is_zero()) throw RandomizationFailed();
          continue;
        }
        ++rank;
        const F inverse_d = d.inverse();
        inverse[static_cast<std::size_t>(k)] = inverse_d;
        for (std::int32_t i = k + 1; i < size_; ++i) {
          F* r = row(i);
          scaled(i)[done] = r[k];
          r[k] = r[k] * inverse_d;
        }
      }
      update_trailing(p0, p1, width);
    }
    return rank;
  }

 private:
  F* scaled(std::int32_t i) { return scaled_.data() + static_cast<std::size_t>(i) * kPanel; }

  static F dot(const F* a, const F* b, std::int32_t n) {
    Wide s = 0;
    for (std::int32_t t = 0; t < n; ++t) s += static_cast<Wide>(a[t].value) * b[t].value;
    return F(F::reduce(s));
  }

  // A_ij -= sum over the panel of L_it (D L)_jt, two rows by two columns at a time.
  void update_trailing(std::int32_t p0, std::int32_t p1, std::int32_t width) {
    static_assert(kPanel < F::kDeferred);
    for (std::int32_t i = p1; i < size_; i += 2) {
      F* r0 = row(i);
      const bool two = i + 1 < size_;
      F* r1 = two ? row(i + 1) : r0;
      const F *l0 = r0 + p0, *l1 = r1 + p0;
      const std::int32_t end = two ? i + 2 : i + 1;
      std::int32_t j = p1;
      for (; j + 1 < end; j += 2) {
        const F *q0 = scaled(j), *q1 = scaled(j + 1);
        Wide s00 = 0, s01 = 0, s10 = 0, s11 = 0;
        for (std::int32_t t = 0; t < width; ++t) {
          const std::uint64_t x0 = l0[t].value, x1 = l1[t].value, y0 = q0[t].value, y1 = q1[t].value;
          s00 += static_cast<Wide>(x0) * y0;
          s01 += static_cast<Wide>(x0) * y1;
          s10 += static_cast<Wide>(x1) * y0;
          s11 += static_cast<Wide>(x1) * y1;
        }
        r0[j] = r0[j] - F(F::reduce(s00));
        if (j + 1 <= i) r0[j + 1] = r0[j + 1] - F(F::reduce(s01));
        if (two) {
          r1[j] = r1[j] - F(F::reduce(s10));
          r1[j + 1] = r1[j + 1] - F(F::reduce(s11));
        }
      }
      for (; j < end; ++j) {
        if (j <= i) r0[j] = r0[j] - dot(l0, scaled(j), width);
        if (two) r1[j] = r1[j] - dot(l1, scaled(j), width);
      }
    }
  }

  std::int32_t size_ = 0;
  std::vector<F> a_, scaled_;
};

// What a supernode passes to its parent: the Schur complement on the nodes below, packed lower triangle.
template <class F>
struct Update {
  std::vector<F> triangle;
};

}  // namespace

template <class F>
ModularLdlt<F>::ModularLdlt(const EliminationTree& tree, const std::vector<std::int8_t>& dofs,
                            const std::vector<FieldRow<F>>& rows, std::uint64_t seed, bool keep) {
  const auto u = [](auto i) { return static_cast<std::size_t>(i); };
  const std::size_t nodes = dofs.size();
  offset_.resize(nodes);
  for (std::size_t n = 0; n < nodes; ++n) offset_[n] = columns_, columns_ += dofs[n];
  dependent_.assign(u(columns_), 0);
  if (keep) factors_.resize(tree.supernodes.size());

  // Rows by the supernode of their first eliminated node.
  const auto supernode_of_row = [&](const FieldRow<F>& row) {
    std::int32_t first = -1;
    for (std::int32_t n : row.node)
      if (n >= 0 && (first < 0 || tree.position[u(n)] < first)) first = tree.position[u(n)];
    return first < 0 ? -1 : tree.supernode_of[u(first)];
  };
  std::vector<std::int32_t> row_start(tree.supernodes.size() + 1, 0), row_list;
  for (const auto& row : rows)
    if (const auto s = supernode_of_row(row); s >= 0) ++row_start[u(s) + 1];
  for (std::size_t s = 0; s < tree.supernodes.size(); ++s) row_start[s + 1] += row_start[s];
  row_list.resize(u(row_start.back()));
  {
    std::vector<std::int32_t> next(row_start.begin(), row_start.end() - 1);
    for (std::size_t r = 0; r < rows.size(); ++r)
      if (const auto s = supernode_of_row(rows[r]); s >= 0) row_list[u(next[u(s)]++)] = static_cast<std::int32_t>(r);
  }
  std::vector<std::int32_t> first_child(tree.supernodes.size(), -1), sibling(tree.supernodes.size(), -1);
  for (std::size_t s = 0; s < tree.supernodes.size(); ++s)
    if (const auto p = tree.supernodes[s].parent; p >= 0)
      sibling[s] = first_child[u(p)], first_child[u(p)] = static_cast<std::int32_t>(s);

  Front<F> front;
  std::vector<Update<F>> updates(tree.supernodes.size());
  std::vector<std::int32_t> local(nodes, 0);  // position -> first row of that node in the current front
  std::vector<std::int32_t> map;
  std::vector<F> inverse;
  for (std::size_t s = 0; s < tree.supernodes.size(); ++s) {
    const Supernode& node = tree.supernodes[s];
    std::int32_t size = 0;
    const auto place = [&](std::int32_t position) {
      local[u(position)] = size;
      size += dofs[u(tree.node_at[u(position)])];
    };
    for (std::int32_t p = node.first; p < node.last; ++p) place(p);
    const std::int32_t pivots = size;
    for (std::int32_t p : node.below) place(p);
    front.reset(size);

    for (std::int32_t e = row_start[s]; e < row_start[s + 1]; ++e) {
      const auto r = u(row_list[u(e)]);
      const FieldRow<F>& row = rows[r];
      const F w = weight(seed, r);
      std::array<std::int32_t, 9> at;
      std::array<F, 9> value;
      std::size_t n = 0;
      for (std::size_t b = 0; b < 3; ++b) {
        if (row.node[b] < 0) continue;
        const std::int32_t begin = local[u(tree.position[u(row.node[b])])];
        for (std::int32_t d = 0; d < dofs[u(row.node[b])]; ++d) {
          if (row.value[b][u(d)].is_zero()) continue;
          at[n] = begin + d, value[n++] = row.value[b][u(d)];
        }
      }
      for (std::size_t i = 0; i < n; ++i) {
        const F wi = w * value[i];
        for (std::size_t j = 0; j <= i; ++j) front.add(at[i], at[j], wi * value[j]);
      }
    }
    for (std::int32_t c = first_child[s]; c >= 0; c = sibling[u(c)]) {
      map.clear();
      for (std::int32_t p : tree.supernodes[u(c)].below)
        for (std::int32_t d = 0; d < dofs[u(tree.node_at[u(p)])]; ++d) map.push_back(local[u(p)] + d);
      const F* t = updates[u(c)].triangle.data();
      for (std::size_t i = 0; i < map.size(); ++i) {  // the map ascends: a lower triangle goes to a lower triangle
        F* target = front.row(map[i]);
        for (std::size_t j = 0; j <= i; ++j) target[map[j]] = target[map[j]] + *t++;
      }
      std::vector<F>().swap(updates[u(c)].triangle);
    }

    rank_ += front.eliminate(pivots, inverse);
    const auto entry_of = [&](std::int32_t p, std::int32_t d) { return offset_[u(tree.node_at[u(p)])] + d; };
    for (std::int32_t p = node.first; p < node.last; ++p)
      for (std::int32_t d = 0; d < dofs[u(tree.node_at[u(p)])]; ++d)
        dependent_[u(entry_of(p, d))] = inverse[u(local[u(p)] + d)].is_zero();
    if (size > pivots && node.parent >= 0) {
      auto& triangle = updates[s].triangle;
      triangle.reserve(u(size - pivots) * u(size - pivots + 1) / 2);
      for (std::int32_t i = pivots; i < size; ++i)
        triangle.insert(triangle.end(), front.row(i) + pivots, front.row(i) + i + 1);
    }
    if (keep) {
      Factor& f = factors_[s];
      f.pivots = pivots;
      f.inverse_pivot = inverse;
      f.entry.reserve(u(size));
      for (std::int32_t p = node.first; p < node.last; ++p)
        for (std::int32_t d = 0; d < dofs[u(tree.node_at[u(p)])]; ++d) f.entry.push_back(entry_of(p, d));
      for (std::int32_t p : node.below)
        for (std::int32_t d = 0; d < dofs[u(tree.node_at[u(p)])]; ++d) f.entry.push_back(entry_of(p, d));
      f.lower.reserve(u(size) * u(pivots));
      for (std::int32_t i = 0; i < size; ++i) f.lower.insert(f.lower.end(), front.row(i), front.row(i) + pivots);
    }
  }
}

template <class F>
void ModularLdlt<F>::back_substitute(std::vector<F>& x) const {
  for (std::size_t s = factors_.size(); s-- > 0;) {
    const Factor& f = factors_[s];
    const auto width = static_cast<std::size_t>(f.pivots);
    for (std::size_t k = width; k-- > 0;) {
      F sum = x[static_cast<std::size_t>(f.entry[k])];
      if (!f.inverse_pivot[k].is_zero())
        for (std::size_t i = k + 1; i < f.entry.size(); ++i)
          sum = sum - f.lower[i * width + k] * x[static_cast<std::size_t>(f.entry[i])];
      x[static_cast<std::size_t>(f.entry[k])] = sum;
    }
  }
}

template <class F>
std::vector<F> ModularLdlt<F>::random_null_vector(std::uint64_t seed) const {
  std::vector<F> x(static_cast<std::size_t>(columns_));
  for (std::size_t c = 0; c < x.size(); ++c)
    if (dependent_[c]) x[c] = F::random(seed, c);
  back_substitute(x);
  return x;
}

template <class F>
std::vector<F> ModularLdlt<F>::solve(std::vector<F> b) const {
  for (const Factor& f : factors_) {
    const auto width = static_cast<std::size_t>(f.pivots);
    for (std::size_t k = 0; k < width; ++k) {
      F& at = b[static_cast<std::size_t>(f.entry[k])];
      const F y = at;
      if (f.inverse_pivot[k].is_zero()) {
        if (!y.is_zero()) throw std::logic_error("right-hand side outside the range");
        continue;
      }
      for (std::size_t i = k + 1; i < f.entry.size(); ++i) {
        F& target = b[static_cast<std::size_t>(f.entry[i])];
        target = target - f.lower[i * width + k] * y;
      }
      at = y * f.inverse_pivot[k];
    }
  }
  back_substitute(b);
  return b;
}

template class ModularLdlt<FirstField>;
template class ModularLdlt<SecondField>;

}  // namespace isostat
