#include "analysis/rigidity/clusters.hpp"

#include <algorithm>
#include <map>
#include <numeric>

#include "analysis/rigidity/exact_rank.hpp"
#include "analysis/rigidity/reduced_problem.hpp"
#include "dem/input_error.hpp"

namespace isostat {
namespace {

using F = WideField;
constexpr std::uint64_t kMotionSeed = 0xC1057E5;

std::size_t u(std::int64_t i) { return static_cast<std::size_t>(i); }

// By body: Vx, Vy at the origin of its frame, W; the strain last.
using Motion = std::vector<std::array<F, 3>>;

// The rows of a pruned body, given everything else, determine its motion up to free components: those are random.
std::array<F, 3> pruned_motion(const ReducedProblem<F>& problem, const PrunedBody& pruned, const Motion& motion) {
  const auto dofs = u(problem.per_body), count = u(pruned.count);
  std::array<std::array<F, 4>, 3> a{};  // rows of the body, right-hand side last
  for (std::size_t k = 0; k < count; ++k)
    for (const RowBlock<F>& block : problem.rows.of(u(pruned.rows[k])))
      for (std::size_t d = 0; d < 3; ++d) {
        if (block.body != pruned.body)
          a[k][3] = a[k][3] - block.at[d] * motion[u(block.body)][d];
        else if (d < dofs)
          a[k][d] = block.at[d];
      }
  std::array<int, 3> pivot_row = {-1, -1, -1};
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
      for (std::size_t c = 0; c < 4; ++c) a[k][c] = a[k][c] - factor * a[done][c];
    }
    pivot_row[d] = static_cast<int>(done++);
  }
  std::array<F, 3> x{};
  for (std::size_t d = 0; d < dofs; ++d)
    if (pivot_row[d] < 0) x[d] = F::random(kMotionSeed + 1, u(pruned.body) * 3 + d);
  for (std::size_t d = 0; d < dofs; ++d) {
    if (pivot_row[d] < 0) continue;
    const auto& row = a[u(pivot_row[d])];
    x[d] = row[3];
    for (std::size_t c = 0; c < dofs; ++c)
      if (pivot_row[c] < 0) x[d] = x[d] - row[c] * x[c];
  }
  return x;
}

Motion random_motion(const ReducedProblem<F>& problem) {
  Motion motion(u(problem.bodies.count) + 1);
  for (std::uint64_t attempt = 0;; ++attempt) {
    try {
      const ModularLdlt<F> ldlt(problem.tree, problem.dofs, problem.node_rows(problem.rows), 991 + attempt, true);
      const std::vector<F> x = ldlt.random_null_vector(kMotionSeed);
      for (std::size_t n = 0; n < problem.body_of_node.size(); ++n) {
        const auto at = u(ldlt.offset(static_cast<std::int32_t>(n)));
        for (std::size_t d = 0; d < u(problem.dofs[n]); ++d) motion[u(problem.body_of_node[n])][d] = x[at + d];
      }
      break;
    } catch (const RandomizationFailed&) {
      if (attempt == 3) throw;
    }
  }
  for (std::int32_t b : problem.network.bodies)  // without rows: free
    if (problem.node_of_body[u(b)] < 0)
      for (std::size_t d = 0; d < u(problem.per_body); ++d) motion[u(b)][d] = F::random(kMotionSeed + 2, u(b) * 3 + d);
  for (auto p = problem.network.pruned.rbegin(); p != problem.network.pruned.rend(); ++p)
    motion[u(p->body)] = pruned_motion(problem, *p, motion);
  return motion;
}

class Sets {
 public:
  explicit Sets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }
  std::int32_t find(std::int32_t i) {
    while (parent_[u(i)] != i) i = parent_[u(i)] = parent_[u(parent_[u(i)])];
    return i;
  }
  void join(std::int32_t a, std::int32_t b) { parent_[u(find(b))] = find(a); }

 private:
  std::vector<std::int32_t> parent_;
};

// Links whose two ends move as one rigid body (with friction), labelled by a representative grain; -1: hinges.
std::vector<std::int32_t> label_by_grains(const Packing<2>& packing, const ReducedProblem<F>& problem,
                                          const Motion& motion, const FieldGeometry<F>& geometry) {
  Sets sets(packing.bodies.size());
  std::vector<char> together(packing.links.size(), 0);
  for (std::size_t l = 0; l < packing.links.size(); ++l) {
    const Link<2>& link = packing.links[l];
    const auto &a = motion[u(problem.bodies.body_of[u(link.i)])], &b = motion[u(problem.bodies.body_of[u(link.j)])];
    const FieldVec<F> o = geometry.offset(problem.bodies.image(link));
    // The image of b: V_b - W_b z x o - e o.
    const F vx = b[0] + b[2] * o[1] - motion.back()[0] * o[0], vy = b[1] - b[2] * o[0] - motion.back()[1] * o[1];
    together[l] = a[2] == b[2] && a[0] == vx && a[1] == vy;
    if (together[l]) sets.join(link.i, link.j);
  }
  std::vector<std::int32_t> label(packing.links.size(), -1);
  for (std::size_t l = 0; l < label.size(); ++l)
    if (together[l]) label[l] = sets.find(packing.links[l].i);
  return label;
}

// Frictionless: links at one grain that turn at the same rate are one rigid body. Labelled by a representative link.
std::vector<std::int32_t> label_by_links(const Packing<2>& packing, const Motion& motion,
                                         const FieldGeometry<F>& geometry) {
  Sets sets(packing.links.size());
  std::vector<std::vector<std::pair<std::uint64_t, std::int32_t>>> at_grain(packing.bodies.size());
  for (std::size_t l = 0; l < packing.links.size(); ++l) {
    const Link<2>& link = packing.links[l];
    const FieldVec<F> r = geometry.branch(link), o = geometry.offset(link.shift);
    const auto &a = motion[u(link.i)], &b = motion[u(link.j)];
    const F dx = b[0] - motion.back()[0] * o[0] - a[0], dy = b[1] - motion.back()[1] * o[1] - a[1];
    const F turn = (r[0] * dy - r[1] * dx) * (r[0] * r[0] + r[1] * r[1]).inverse();
    at_grain[u(link.i)].push_back({turn.value, static_cast<std::int32_t>(l)});
    at_grain[u(link.j)].push_back({turn.value, static_cast<std::int32_t>(l)});
  }
  for (auto& list : at_grain) {
    std::sort(list.begin(), list.end());
    for (std::size_t k = 1; k < list.size(); ++k)
      if (list[k].first == list[k - 1].first) sets.join(list[k].second, list[k - 1].second);
  }
  std::vector<std::int32_t> label(packing.links.size());
  for (std::size_t l = 0; l < label.size(); ++l) label[l] = sets.find(static_cast<std::int32_t>(l));
  return label;
}

// The cluster as a packing of its own; also finds which axes its loops wind around.
RigidCluster describe(const Packing<2>& packing, NetworkLaw law, bool cell_free,
                      const std::vector<std::int32_t>& links) {
  RigidCluster c;
  Packing<2> part;
  part.cell = packing.cell;
  std::map<std::int32_t, std::int32_t> number;
  const auto local = [&](std::int32_t grain) {
    const auto [at, fresh] = number.try_emplace(grain, static_cast<std::int32_t>(part.bodies.position.size()));
    if (fresh) {
      part.bodies.id.push_back(packing.bodies.id[u(grain)]);
      part.bodies.position.push_back(packing.bodies.position[u(grain)]);
      part.bodies.radius.push_back(packing.bodies.radius[u(grain)]);
    }
    return at->second;
  };
  for (std::int32_t l : links) {
    Link<2> link = packing.links[u(l)];
    link.i = local(link.i), link.j = local(link.j);
    part.links.push_back(link);
  }
  c.grains = static_cast<std::int64_t>(part.bodies.size());
  c.links = static_cast<std::int64_t>(links.size());
  c.rows = row_count(part, law);

  // Potentials of images along a spanning tree; a link that disagrees closes a loop round the cell.
  if (packing.cell) {
    std::vector<std::vector<std::int32_t>> incident(part.bodies.size());
    for (std::size_t l = 0; l < part.links.size(); ++l) {
      incident[u(part.links[l].i)].push_back(static_cast<std::int32_t>(l));
      incident[u(part.links[l].j)].push_back(static_cast<std::int32_t>(l));
    }
    std::vector<ImageShift<2>> image(part.bodies.size());
    std::vector<char> seen(part.bodies.size(), 0);
    std::vector<std::int32_t> stack = {0};
    seen[0] = 1;
    while (!stack.empty()) {
      const std::int32_t g = stack.back();
      stack.pop_back();
      for (std::int32_t l : incident[u(g)]) {
        const Link<2>& link = part.links[u(l)];
        const int sign = link.i == g ? 1 : -1;
        const std::int32_t other = link.i == g ? link.j : link.i;
        const ImageShift<2> at = {image[u(g)][0] + sign * link.shift[0], image[u(g)][1] + sign * link.shift[1]};
        if (!seen[u(other)]) {
          seen[u(other)] = 1, image[u(other)] = at;
          stack.push_back(other);
        } else {
          for (std::size_t k = 0; k < 2; ++k) c.spans[k] = c.spans[k] || at[k] != image[u(other)][k];
        }
      }
    }
  }
  // Few rows cannot depend on each other in a cluster without loops; otherwise ask the exact rank.
  const bool tree = c.links < c.grains;
  c.hyperstatic = tree ? 0 : exact_rank(part, law, cell_free).hyperstatic;
  return c;
}

}  // namespace

RigidClusters rigid_clusters(const Packing<2>& packing, NetworkLaw law, bool cell_free) {
  if (cell_free && !packing.cell) throw InputError("command line", 0, "--cell", "free", "the input has no cell");
  const ReducedProblem<F> problem = reduce_problem<F>(packing, law, cell_free);
  const Motion motion = random_motion(problem);
  const FieldGeometry<F> geometry = exact_geometry<F>(packing);
  const std::vector<std::int32_t> label = law == NetworkLaw::frictionless
                                              ? label_by_links(packing, motion, geometry)
                                              : label_by_grains(packing, problem, motion, geometry);
  std::map<std::int32_t, std::vector<std::int32_t>> links_of;
  for (std::size_t l = 0; l < label.size(); ++l)
    if (label[l] >= 0) links_of[label[l]].push_back(static_cast<std::int32_t>(l));

  struct Entry {
    RigidCluster cluster;
    const std::vector<std::int32_t>* links;
  };
  std::vector<Entry> entries;
  for (const auto& [name, links] : links_of) {
    const RigidCluster c = describe(packing, law, cell_free, links);
    if (c.grains >= 2) entries.push_back({c, &links});
  }
  std::stable_sort(entries.begin(), entries.end(),
                   [](const Entry& a, const Entry& b) { return a.cluster.grains > b.cluster.grains; });

  RigidClusters result;
  result.cluster_of_link.assign(packing.links.size(), -1);
  result.cluster_of_grain.assign(packing.bodies.size(), -1);
  for (const Entry& e : entries) {
    const auto index = static_cast<std::int32_t>(result.clusters.size());
    result.clusters.push_back(e.cluster);
    for (std::int32_t l : *e.links) {
      result.cluster_of_link[u(l)] = index;
      for (std::int32_t g : {packing.links[u(l)].i, packing.links[u(l)].j})
        if (result.cluster_of_grain[u(g)] < 0) result.cluster_of_grain[u(g)] = index;
    }
  }
  return result;
}

}  // namespace isostat
