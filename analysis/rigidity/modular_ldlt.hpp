// L D L^T of A = G^T W G modulo a prime, with random weights W, by a multifrontal method without pivoting.
//
// For random W the Schur complement of A at any step is again of the form G'^T W' G', so a zero pivot means (up to a
// chance of about columns / p) that its column depends on those before it: the number of nonzero pivots is the rank
// of G over the field. The whole column must then vanish, which is checked; a failed check throws RandomizationFailed
// and the caller draws other weights.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "analysis/rigidity/elimination_tree.hpp"
#include "analysis/rigidity/modular_front.hpp"
#include "analysis/rigidity/rows.hpp"
#include "geometry/base/index.hpp"

namespace isostat {

// The rows that are eliminated, and the node that each of their bodies has become (-1 does not occur in them).
template <class F, int Most = 3>
struct NodeRows {
  const Rows<F, Most>& rows;
  const std::vector<std::int32_t>& selected;      // indices into rows
  const std::vector<std::int32_t>& node_of_body;  // the strain's last
};

template <class F>
class ModularLdlt {
 public:
  // dofs[node] in 1..Most. keep: store L for solving (memory: the factor). Throws RandomizationFailed.
  template <int Most>
  ModularLdlt(const EliminationTree& tree, const std::vector<std::int8_t>& dofs, const NodeRows<F, Most>& rows,
              std::uint64_t seed, bool keep);

  std::int64_t rank() const { return rank_; }
  std::int64_t columns() const { return columns_; }

  // Offsets of the nodes' dofs in vectors: dof d of node n is entry offset(n) + d.
  std::int64_t offset(std::int32_t node) const { return offset_[idx(node)]; }
  const std::vector<char>& dependent() const { return dependent_; }  // by entry: column depends on earlier ones

  // A random vector of null A = null G; columns - rank free entries. Needs keep.
  std::vector<F> random_null_vector(std::uint64_t seed) const;
  // A solution of A x = b, b in the range of A, zero at the dependent columns. Needs keep.
  std::vector<F> solve(std::vector<F> b) const;

 private:
  struct Factor {
    std::vector<std::int64_t> entry;  // entries of the front: pivots first
    std::int32_t pivots = 0;
    std::vector<F> lower;          // row-major, front x pivots: rows of L, unit diagonal not stored as such
    std::vector<F> inverse_pivot;  // 0 for a dependent column
  };
  void back_substitute(std::vector<F>& x) const;

  std::int64_t rank_ = 0, columns_ = 0;
  std::vector<std::int64_t> offset_;
  std::vector<char> dependent_;
  std::vector<Factor> factors_;
};

extern template class ModularLdlt<FirstField>;
extern template class ModularLdlt<SecondField>;
extern template class ModularLdlt<WideField>;
#define ISOSTAT_LDLT_OF(F, MOST)                                                                       \
  extern template ModularLdlt<F>::ModularLdlt(const EliminationTree&, const std::vector<std::int8_t>&, \
                                              const NodeRows<F, MOST>&, std::uint64_t, bool);
ISOSTAT_LDLT_OF(FirstField, 3)
ISOSTAT_LDLT_OF(SecondField, 3)
ISOSTAT_LDLT_OF(WideField, 3)
ISOSTAT_LDLT_OF(FirstField, 6)
ISOSTAT_LDLT_OF(SecondField, 6)
ISOSTAT_LDLT_OF(WideField, 6)
#undef ISOSTAT_LDLT_OF

}  // namespace isostat
