#include "analysis/rigidity/clusters.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <set>

#include "analysis/rigidity/exact_rank.hpp"
#include "analysis/rigidity/null_motion.hpp"
#include "analysis/rigidity/part_of_packing.hpp"
#include "analysis/rigidity/reduced_problem.hpp"
#include "dem/input_error.hpp"
#include "geometry/base/index.hpp"
#include "geometry/union_find.hpp"

namespace isostat {
namespace {

using F = WideField;
using Motion = NullMotion<LinkNetwork>;

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
  const auto problem = reduce_problem<F>(network, law, cell_free);
  const Motion motion = random_null_motion(problem);
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
    result.links.push_back(*e.links);
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
