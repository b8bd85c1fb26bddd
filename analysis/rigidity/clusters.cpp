#include "analysis/rigidity/clusters.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <set>

#include "analysis/rigidity/exact_rank.hpp"
#include "analysis/rigidity/part_of_packing.hpp"
#include "analysis/rigidity/reduced_problem.hpp"
#include "dem/input_error.hpp"
#include "geometry/base/index.hpp"
#include "geometry/union_find.hpp"

namespace isostat {
namespace {

using F = WideField;
constexpr std::uint64_t kMotionSeed = 0xC1057E5;

// By body: Vx, Vy at the origin of its frame, W; the strain last.
using Motion = std::vector<std::array<F, 3>>;

// The rows of a pruned body, given everything else, determine its motion up to free components: those are random.
std::array<F, 3> pruned_motion(const ReducedProblem<F>& problem, const PrunedBody& pruned, const Motion& motion) {
  const auto dofs = idx(problem.per_body), count = idx(pruned.count);
  std::array<std::array<F, 4>, 3> a{};  // rows of the body, right-hand side last
  for (std::size_t k = 0; k < count; ++k)
    for (const RowBlock<F>& block : problem.rows.of(idx(pruned.rows[k])))
      for (std::size_t d = 0; d < 3; ++d) {
        if (block.body != pruned.body)
          a[k][3] = a[k][3] - block.at[d] * motion[idx(block.body)][d];
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
    if (pivot_row[d] < 0) x[d] = F::random(kMotionSeed + 1, idx(pruned.body) * 3 + d);
  for (std::size_t d = 0; d < dofs; ++d) {
    if (pivot_row[d] < 0) continue;
    const auto& row = a[idx(pivot_row[d])];
    x[d] = row[3];
    for (std::size_t c = 0; c < dofs; ++c)
      if (pivot_row[c] < 0) x[d] = x[d] - row[c] * x[c];
  }
  return x;
}

Motion random_motion(const ReducedProblem<F>& problem) {
  Motion motion(idx(problem.bodies.count) + 1);
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
        motion[idx(b)][d] = F::random(kMotionSeed + 2, idx(b) * 3 + d);
  for (auto p = problem.network.pruned.rbegin(); p != problem.network.pruned.rend(); ++p)
    motion[idx(p->body)] = pruned_motion(problem, *p, motion);
  return motion;
}

// Links whose bodies move as one rigid body (with friction; an overlap with all its triangles), labelled by a
// representative body; -1: hinges. The walls are one body.
std::vector<std::int32_t> label_by_grains(const LinkNetwork& network, const ReducedProblem<F>& problem,
                                          const Motion& motion, const FieldGeometry<F>& geometry) {
  UnionFind sets(network.packing.bodies.size());
  for (std::size_t b = idx(network.free); b + 1 < network.packing.bodies.size(); ++b) sets.join(b, b + 1);
  std::vector<char> together(network.links(), 1);
  std::vector<std::int32_t> first(network.links(), 0);
  const auto of = [&](std::int32_t body) {  // a held body stands still
    const std::int32_t rigid = problem.bodies.body_of[idx(body)];
    return rigid == RigidBodies::held ? std::array<F, 3>{} : motion[idx(rigid)];
  };
  const auto alike = [&](std::int32_t i, std::int32_t j, const ImageShift<2>& shift) {
    const auto a = of(i), b = of(j);
    const FieldVec<F> o = geometry.offset(problem.bodies.image(i, j, shift));
    // The image of b: V_b - W_b z x o - e o.
    const F vx = b[0] + b[2] * o[1] - motion.back()[0] * o[0], vy = b[1] - b[2] * o[0] - motion.back()[1] * o[1];
    return a[2] == b[2] && a[0] == vx && a[1] == vy;
  };
  for (std::size_t l = 0; l < together.size(); ++l) {
    first[l] = network.is_area(l) ? network.area(l).pairs[0].i : network.packing.links[l].i;
    network.each_bond(l, [&](std::int32_t i, std::int32_t j, const ImageShift<2>& shift) {
      together[l] = together[l] && alike(i, j, shift) && alike(first[l], i, {});
    });
    if (together[l])
      network.each_bond(l, [&](std::int32_t i, std::int32_t j, const ImageShift<2>&) {
        sets.join(idx(j), idx(i)), sets.join(idx(i), idx(first[l]));
      });
  }
  std::vector<std::int32_t> label(network.links(), -1);
  for (std::size_t l = 0; l < label.size(); ++l)
    if (together[l]) label[l] = static_cast<std::int32_t>(sets.find(idx(first[l])));
  return label;
}

// Frictionless: links at one grain that turn at the same rate are one rigid body (a beam turns with its two grains),
// and so are all that do not turn at a wall.
// Labelled by a representative link.
std::vector<std::int32_t> label_by_links(const LinkNetwork& network, const ReducedProblem<F>& problem,
                                         const Motion& motion, const FieldGeometry<F>& geometry) {
  const Packing<2>& packing = network.packing;
  const auto& strain = motion.back();
  std::vector<FieldVec<F>> velocity(packing.bodies.size());  // of the centres: V + W z x x of the image in the frame
  for (std::size_t i = 0; i < velocity.size(); ++i) {
    if (problem.bodies.body_of[i] == RigidBodies::held) continue;
    const auto& body = motion[idx(problem.bodies.body_of[i])];
    const FieldVec<F> x = geometry.placed(i, problem.bodies.placement[i]),
                      o = geometry.offset(problem.bodies.placement[i]);
    velocity[i] = {body[0] - body[2] * x[1] + strain[0] * o[0], body[1] + body[2] * x[0] + strain[1] * o[1]};
  }
  UnionFind sets(packing.links.size());
  std::int32_t standing = -1;  // a link that stands still with the walls
  std::vector<std::vector<std::pair<std::uint64_t, std::int32_t>>> at_grain(packing.bodies.size());
  for (std::size_t l = 0; l < packing.links.size(); ++l) {
    const Link<2>& link = packing.links[l];
    const FieldVec<F> r = geometry.branch(link), o = geometry.offset(link.shift);
    const auto &a = velocity[idx(link.i)], &b = velocity[idx(link.j)];
    const F dx = b[0] - strain[0] * o[0] - a[0], dy = b[1] - strain[1] * o[1] - a[1];
    const F turn = (r[0] * dy - r[1] * dx) * (r[0] * r[0] + r[1] * r[1]).inverse();
    at_grain[idx(link.i)].push_back({turn.value, static_cast<std::int32_t>(l)});
    at_grain[idx(link.j)].push_back({turn.value, static_cast<std::int32_t>(l)});
    if ((network.is_free(link.i) && network.is_free(link.j)) || !turn.is_zero()) continue;
    if (standing < 0) standing = static_cast<std::int32_t>(l);
    sets.join(idx(standing), l);
  }
  for (auto& list : at_grain) {
    std::sort(list.begin(), list.end());
    for (std::size_t k = 1; k < list.size(); ++k)
      if (list[k].first == list[k - 1].first) sets.join(idx(list[k - 1].second), idx(list[k].second));
  }
  std::vector<std::int32_t> label(packing.links.size());
  for (std::size_t l = 0; l < label.size(); ++l) label[l] = static_cast<std::int32_t>(sets.find(l));
  return label;
}

// The cluster as a packing of its own; also finds which axes its loops wind around. None: what is one grain alone.
std::optional<RigidCluster> describe(const LinkNetwork& network, NetworkLaw law, bool cell_free,
                                     const std::vector<std::int32_t>& links) {
  RigidCluster c;
  const OwnedNetwork owned = part_of(network, {}, links);
  const LinkNetwork part = owned.view();
  const std::size_t bodies = owned.packing.bodies.size();
  const std::set<std::int32_t> members(owned.grain.begin(), owned.grain.end()),
      free(owned.grain.begin(), owned.grain.begin() + std::min<std::ptrdiff_t>(owned.free, std::ssize(owned.grain)));
  c.grains = part.of_triangles() ? static_cast<std::int64_t>(free.size()) : owned.free;
  c.links = static_cast<std::int64_t>(links.size());
  if ((part.of_triangles() ? members.size() : bodies) < 2) return std::nullopt;
  c.rows = row_count(part, law);

  // Potentials of images along a spanning tree; a link that disagrees closes a loop round the cell.
  if (part.packing.cell) {
    struct Bond {
      std::int32_t i, j;
      ImageShift<2> shift;
    };
    std::vector<Bond> bonds;
    std::vector<std::vector<std::size_t>> incident(bodies);
    for (std::size_t l = 0; l < part.links(); ++l)
      part.each_bond(l, [&](std::int32_t i, std::int32_t j, const ImageShift<2>& shift) {
        incident[idx(i)].push_back(bonds.size()), incident[idx(j)].push_back(bonds.size());
        bonds.push_back({i, j, shift});
      });
    std::vector<ImageShift<2>> image(bodies);
    std::vector<char> seen(bodies, 0);
    std::vector<std::int32_t> stack = {0};
    seen[0] = 1;
    while (!stack.empty()) {
      const std::int32_t g = stack.back();
      stack.pop_back();
      for (const std::size_t l : incident[idx(g)]) {
        const Bond& bond = bonds[l];
        const int sign = bond.i == g ? 1 : -1;
        const std::int32_t other = bond.i == g ? bond.j : bond.i;
        const ImageShift<2> at = {image[idx(g)][0] + sign * bond.shift[0], image[idx(g)][1] + sign * bond.shift[1]};
        if (!seen[idx(other)]) {
          seen[idx(other)] = 1, image[idx(other)] = at;
          stack.push_back(other);
        } else {
          for (std::size_t k = 0; k < 2; ++k) c.spans[k] = c.spans[k] || at[k] != image[idx(other)][k];
        }
      }
    }
  }
  // Few rows cannot depend on each other in a cluster without loops; otherwise ask the exact rank.
  const bool tree = !part.of_triangles() && !part.any_held() && c.links < c.grains;
  c.hyperstatic = tree ? 0 : exact_rank(part, law, cell_free).hyperstatic;
  return c;
}

}  // namespace

RigidClusters rigid_clusters(const LinkNetwork& network, NetworkLaw law, bool cell_free) {
  const Packing<2>& packing = network.packing;
  if (cell_free && !packing.cell) throw InputError("command line", 0, "--cell", "free", "the input has no cell");
  const ReducedProblem<F> problem = reduce_problem<F>(network, law, cell_free);
  const Motion motion = random_motion(problem);
  const FieldGeometry<F> geometry = exact_geometry<F>(network);
  const std::vector<std::int32_t> label = law == NetworkLaw::frictionless && !network.of_triangles()
                                              ? label_by_links(network, problem, motion, geometry)
                                              : label_by_grains(network, problem, motion, geometry);
  std::map<std::int32_t, std::vector<std::int32_t>> links_of;
  for (std::size_t l = 0; l < label.size(); ++l)
    if (label[l] >= 0) links_of[label[l]].push_back(static_cast<std::int32_t>(l));

  struct Entry {
    RigidCluster cluster;
    const std::vector<std::int32_t>* links;
  };
  std::vector<Entry> entries;
  for (const auto& [name, links] : links_of) {
    if (const auto c = describe(network, law, cell_free, links)) entries.push_back({*c, &links});
  }
  std::stable_sort(entries.begin(), entries.end(),
                   [](const Entry& a, const Entry& b) { return a.cluster.grains > b.cluster.grains; });

  RigidClusters result;
  result.cluster_of_link.assign(network.links(), -1);
  result.cluster_of_grain.assign(packing.bodies.size(), -1);
  for (const Entry& e : entries) {
    const auto index = static_cast<std::int32_t>(result.clusters.size());
    result.clusters.push_back(e.cluster);
    for (std::int32_t l : *e.links) {
      result.cluster_of_link[idx(l)] = index;
      network.each_bond(idx(l), [&](std::int32_t i, std::int32_t j, const ImageShift<2>&) {
        for (const std::int32_t g : {i, j})
          if (result.cluster_of_grain[idx(g)] < 0) result.cluster_of_grain[idx(g)] = index;
      });
    }
  }
  return result;
}

}  // namespace isostat
