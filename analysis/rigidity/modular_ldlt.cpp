#include "analysis/rigidity/modular_ldlt.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "analysis/rigidity/modular_front.hpp"
#include "geometry/base/index.hpp"

namespace isostat {
namespace {

// One supernode after the other, children before parents: its front is numbered, filled with the rows that begin in it
// and with what its children left, eliminated, and its Schur complement kept for its parent.
template <class F, int Most>
class FrontSequence {
 public:
  FrontSequence(const EliminationTree& tree, const std::vector<std::int8_t>& dofs, const NodeRows<F, Most>& rows,
                std::uint64_t seed)
      : tree_(tree), dofs_(dofs), rows_(rows), seed_(seed), updates_(tree.supernodes.size()), local_(dofs.size(), 0) {
    sort_rows();
    first_child_.assign(tree.supernodes.size(), -1), sibling_.assign(tree.supernodes.size(), -1);
    for (std::size_t s = 0; s < tree.supernodes.size(); ++s)
      if (const auto p = tree.supernodes[s].parent; p >= 0)
        sibling_[s] = first_child_[idx(p)], first_child_[idx(p)] = static_cast<std::int32_t>(s);
  }

  // Numbers the dofs of the supernode's front, those to be eliminated first, and clears it.
  void place_supernode(std::size_t s) {
    const Supernode& node = tree_.supernodes[s];
    std::int32_t size = 0;
    const auto place = [&](std::int32_t position) { local_[idx(position)] = size, size += dofs_at(position); };
    for (std::int32_t p = node.first; p < node.last; ++p) place(p);
    pivots_ = size;
    for (std::int32_t p : node.below) place(p);
    front_.reset(size);
  }

  // Adds w g g^T of the rows g whose first eliminated node is in the supernode.
  void add_rows(std::size_t s) {
    for (std::int32_t e = row_start_[s]; e < row_start_[s + 1]; ++e) {
      const auto r = idx(row_list_[idx(e)]);
      at_.clear(), value_.clear();
      for (const RowBlock<F, Most>& block : blocks(r)) {
        const std::int32_t node = node_of(block), begin = local_[idx(tree_.position[idx(node)])];
        for (std::int32_t d = 0; d < dofs_[idx(node)]; ++d)
          if (!block.at[idx(d)].is_zero()) at_.push_back(begin + d), value_.push_back(block.at[idx(d)]);
      }
      const F weight = F::random(seed_, r);
      for (std::size_t i = 0; i < at_.size(); ++i) {
        const F scaled = weight * value_[i];
        for (std::size_t j = 0; j <= i; ++j) front_.add(at_[i], at_[j], scaled * value_[j]);
      }
    }
  }

  void add_children(std::size_t s) {
    for (std::int32_t c = first_child_[s]; c >= 0; c = sibling_[idx(c)]) {
      at_.clear();
      for (std::int32_t p : tree_.supernodes[idx(c)].below)
        for (std::int32_t d = 0; d < dofs_at(p); ++d) at_.push_back(local_[idx(p)] + d);
      const F* t = updates_[idx(c)].data();
      for (std::size_t i = 0; i < at_.size(); ++i) {  // the map ascends: a lower triangle goes to a lower triangle
        F* target = front_.row(at_[i]);
        for (std::size_t j = 0; j <= i; ++j) target[at_[j]] = target[at_[j]] + *t++;
      }
      std::vector<F>().swap(updates_[idx(c)]);
    }
  }

  // Number of nonzero pivots. Throws RandomizationFailed.
  std::int32_t eliminate() { return front_.eliminate(pivots_, inverse_); }

  // The Schur complement on the nodes below, packed lower triangle, waits for the parent.
  void pass_up(std::size_t s) {
    const std::int32_t size = front_.size();
    if (size == pivots_ || tree_.supernodes[s].parent < 0) return;
    updates_[s].reserve(idx(size - pivots_) * idx(size - pivots_ + 1) / 2);
    for (std::int32_t i = pivots_; i < size; ++i)
      updates_[s].insert(updates_[s].end(), front_.row(i) + pivots_, front_.row(i) + i + 1);
  }

  std::int32_t pivots() const { return pivots_; }
  const std::vector<F>& inverse() const { return inverse_; }  // of the pivots, 0 for a dependent column
  std::vector<F> lower() {                                    // front x pivots, row-major
    std::vector<F> lower;
    lower.reserve(idx(front_.size()) * idx(pivots_));
    for (std::int32_t i = 0; i < front_.size(); ++i) lower.insert(lower.end(), front_.row(i), front_.row(i) + pivots_);
    return lower;
  }

 private:
  std::int32_t dofs_at(std::int32_t position) const { return dofs_[idx(tree_.node_at[idx(position)])]; }
  std::span<const RowBlock<F, Most>> blocks(std::size_t row) const { return rows_.rows.of(idx(rows_.selected[row])); }
  std::int32_t node_of(const RowBlock<F, Most>& block) const { return rows_.node_of_body[idx(block.body)]; }

  std::int32_t first_supernode(std::size_t row) const {
    std::int32_t first = std::numeric_limits<std::int32_t>::max();
    for (const RowBlock<F, Most>& block : blocks(row)) first = std::min(first, tree_.position[idx(node_of(block))]);
    return tree_.supernode_of[idx(first)];
  }
  void sort_rows() {  // by the supernode of their first eliminated node
    row_start_.assign(tree_.supernodes.size() + 1, 0);
    for (std::size_t r = 0; r < rows_.selected.size(); ++r) ++row_start_[idx(first_supernode(r)) + 1];
    std::partial_sum(row_start_.begin(), row_start_.end(), row_start_.begin());
    row_list_.resize(idx(row_start_.back()));
    std::vector<std::int32_t> next(row_start_.begin(), row_start_.end() - 1);
    for (std::size_t r = 0; r < rows_.selected.size(); ++r)
      row_list_[idx(next[idx(first_supernode(r))]++)] = static_cast<std::int32_t>(r);
  }

  const EliminationTree& tree_;
  const std::vector<std::int8_t>& dofs_;
  const NodeRows<F, Most>& rows_;
  std::uint64_t seed_;
  ModularFront<F> front_;
  std::int32_t pivots_ = 0;
  std::vector<F> inverse_;
  std::vector<std::vector<F>> updates_;              // by supernode, what it passes to its parent
  std::vector<std::int32_t> local_;                  // position -> first row of that node in the current front
  std::vector<std::int32_t> row_start_, row_list_;   // rows by supernode
  std::vector<std::int32_t> first_child_, sibling_;  // of supernodes
  std::vector<std::int32_t> at_;                     // entries of one row, or of one child
  std::vector<F> value_;
};

}  // namespace

template <class F>
template <int Most>
ModularLdlt<F>::ModularLdlt(const EliminationTree& tree, const std::vector<std::int8_t>& dofs,
                            const NodeRows<F, Most>& rows, std::uint64_t seed, bool keep) {
  offset_.resize(dofs.size());
  for (std::size_t n = 0; n < dofs.size(); ++n) offset_[n] = columns_, columns_ += dofs[n];
  dependent_.assign(idx(columns_), 0);

  FrontSequence<F, Most> fronts(tree, dofs, rows, seed);
  for (std::size_t s = 0; s < tree.supernodes.size(); ++s) {
    fronts.place_supernode(s);
    fronts.add_rows(s);
    fronts.add_children(s);
    rank_ += fronts.eliminate();
    fronts.pass_up(s);

    std::vector<std::int64_t> entry;  // of the front
    const auto append = [&](std::int32_t position) {
      const std::int32_t node = tree.node_at[idx(position)];
      for (std::int32_t d = 0; d < dofs[idx(node)]; ++d) entry.push_back(offset(node) + d);
    };
    for (std::int32_t p = tree.supernodes[s].first; p < tree.supernodes[s].last; ++p) append(p);
    for (std::size_t k = 0; k < entry.size(); ++k) dependent_[idx(entry[k])] = fronts.inverse()[k].is_zero();
    if (!keep) continue;
    for (std::int32_t p : tree.supernodes[s].below) append(p);
    factors_.push_back({std::move(entry), fronts.pivots(), fronts.lower(), fronts.inverse()});
  }
}

template <class F>
void ModularLdlt<F>::back_substitute(std::vector<F>& x) const {
  for (std::size_t s = factors_.size(); s-- > 0;) {
    const Factor& f = factors_[s];
    const auto width = idx(f.pivots);
    for (std::size_t k = width; k-- > 0;) {
      F sum = x[idx(f.entry[k])];
      if (!f.inverse_pivot[k].is_zero())
        for (std::size_t i = k + 1; i < f.entry.size(); ++i) sum = sum - f.lower[i * width + k] * x[idx(f.entry[i])];
      x[idx(f.entry[k])] = sum;
    }
  }
}

template <class F>
std::vector<F> ModularLdlt<F>::random_null_vector(std::uint64_t seed) const {
  std::vector<F> x(idx(columns_));
  for (std::size_t c = 0; c < x.size(); ++c)
    if (dependent_[c]) x[c] = F::random(seed, c);
  back_substitute(x);
  return x;
}

template <class F>
std::vector<F> ModularLdlt<F>::solve(std::vector<F> b) const {
  for (const Factor& f : factors_) {
    const auto width = idx(f.pivots);
    for (std::size_t k = 0; k < width; ++k) {
      F& at = b[idx(f.entry[k])];
      const F y = at;
      if (f.inverse_pivot[k].is_zero()) {
        if (!y.is_zero()) throw std::logic_error("right-hand side outside the range");
        continue;
      }
      for (std::size_t i = k + 1; i < f.entry.size(); ++i) {
        F& target = b[idx(f.entry[i])];
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
#define ISOSTAT_LDLT_OF(F, MOST)                                                                \
  template ModularLdlt<F>::ModularLdlt(const EliminationTree&, const std::vector<std::int8_t>&, \
                                       const NodeRows<F, MOST>&, std::uint64_t, bool);
ISOSTAT_LDLT_OF(FirstField, 3)
ISOSTAT_LDLT_OF(SecondField, 3)
ISOSTAT_LDLT_OF(WideField, 3)
ISOSTAT_LDLT_OF(FirstField, 6)
ISOSTAT_LDLT_OF(SecondField, 6)
ISOSTAT_LDLT_OF(WideField, 6)
#undef ISOSTAT_LDLT_OF

}  // namespace isostat
