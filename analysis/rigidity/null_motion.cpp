#include "analysis/rigidity/null_motion.hpp"

#include "geometry/base/index.hpp"

namespace isostat {
namespace {

using F = WideField;
constexpr std::uint64_t kMotionSeed = 0xC1057E5;

// The rows of a pruned body, given everything else, determine its motion up to free components: those are random.
template <class Network, int Most = kMostDofs<Network>>
std::array<F, Most> pruned_motion(const ReducedProblem<F, Network>& problem, const PrunedBody<Most>& pruned,
                                  const NullMotion<Network>& motion) {
  const auto dofs = idx(problem.per_body), count = idx(pruned.count);
  std::array<std::array<F, Most + 1>, Most> a{};  // rows of the body, right-hand side last
  for (std::size_t k = 0; k < count; ++k)
    for (const RowBlock<F, Most>& block : problem.rows.of(idx(pruned.rows[k])))
      for (std::size_t d = 0; d < Most; ++d) {
        if (block.body != pruned.body)
          a[k][Most] = a[k][Most] - block.at[d] * motion[idx(block.body)][d];
        else if (d < dofs)
          a[k][d] = block.at[d];
      }
  std::array<int, Most> pivot_row;
  pivot_row.fill(-1);
  std::size_t done = 0;
  for (std::size_t d = 0; d < dofs && done < count; ++d) {
    std::size_t p = done;
    while (p < count && a[p][d].is_zero()) ++p;
    if (p == count) continue;
    std::swap(a[p], a[done]);
    const F inverse = a[done][d].inverse();
    for (F& v : a[done]) v = v * inverse;
    for (std::size_t k = 0; k < count; ++k) {
      if (k == done || a[k][d].is_zero()) continue;
      const F factor = a[k][d];
      for (std::size_t c = 0; c <= Most; ++c) a[k][c] = a[k][c] - factor * a[done][c];
    }
    pivot_row[d] = static_cast<int>(done++);
  }
  std::array<F, Most> x{};
  for (std::size_t d = 0; d < dofs; ++d)
    if (pivot_row[d] < 0) x[d] = F::random(kMotionSeed + 1, idx(pruned.body) * Most + d);
  for (std::size_t d = 0; d < dofs; ++d) {
    if (pivot_row[d] < 0) continue;
    const auto& row = a[idx(pivot_row[d])];
    x[d] = row[Most];
    for (std::size_t c = 0; c < dofs; ++c)
      if (pivot_row[c] < 0) x[d] = x[d] - row[c] * x[c];
  }
  return x;
}

}  // namespace

template <class Network>
NullMotion<Network> random_null_motion(const ReducedProblem<F, Network>& problem) {
  constexpr int Most = kMostDofs<Network>;
  NullMotion<Network> motion(idx(problem.bodies.count) + 1);
  for (std::uint64_t attempt = 0;; ++attempt) {
    try {
      const ModularLdlt<F> ldlt(problem.tree, problem.dofs, problem.node_rows(problem.rows), 991 + attempt, true);
      const std::vector<F> x = ldlt.random_null_vector(kMotionSeed);
      for (std::size_t n = 0; n < problem.body_of_node.size(); ++n) {
        const auto at = idx(ldlt.offset(static_cast<std::int32_t>(n)));
        for (std::size_t d = 0; d < idx(problem.dofs[n]); ++d) motion[idx(problem.body_of_node[n])][d] = x[at + d];
      }
      break;
    } catch (const RandomizationFailed&) {
      if (attempt == 3) throw;
    }
  }
  for (std::int32_t b : problem.network.bodies)  // without rows: free
    if (problem.node_of_body[idx(b)] < 0)
      for (std::size_t d = 0; d < idx(problem.per_body); ++d)
        motion[idx(b)][d] = F::random(kMotionSeed + 2, idx(b) * Most + d);
  for (auto p = problem.network.pruned.rbegin(); p != problem.network.pruned.rend(); ++p)
    motion[idx(p->body)] = pruned_motion<Network>(problem, *p, motion);
  return motion;
}

template NullMotion<LinkNetwork> random_null_motion(const ReducedProblem<F, LinkNetwork>&);
template NullMotion<SphereNetwork> random_null_motion(const ReducedProblem<F, SphereNetwork>&);

}  // namespace isostat
