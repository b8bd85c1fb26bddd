#include "analysis/rigidity/modular_ldlt.hpp"

#include "analysis/rigidity/modular_front.hpp"

namespace isostat {
namespace {

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

  ModularFront<F> front;
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
template class ModularLdlt<WideField>;

}  // namespace isostat
