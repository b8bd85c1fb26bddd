#include "analysis/rigidity/elimination_tree.hpp"

#include <amd.h>
#include <metis.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "analysis/one_thread.hpp"

namespace isostat {
namespace {

using Int = std::int32_t;
std::size_t u(Int i) { return static_cast<std::size_t>(i); }

struct Adjacency {
  std::vector<Int> start, node;
};

// Both directions, no loops, no repeats, sorted.
Adjacency adjacency(Int nodes, const std::vector<std::pair<Int, Int>>& edges, Int left_out) {
  Adjacency a;
  a.start.assign(u(nodes) + 1, 0);
  const auto counts = [&](const std::pair<Int, Int>& e) {
    return e.first != e.second && e.first != left_out && e.second != left_out;
  };
  for (const auto& e : edges)
    if (counts(e)) ++a.start[u(e.first) + 1], ++a.start[u(e.second) + 1];
  std::partial_sum(a.start.begin(), a.start.end(), a.start.begin());
  a.node.resize(u(a.start.back()));
  std::vector<Int> next(a.start.begin(), a.start.end() - 1);
  for (const auto& e : edges)
    if (counts(e)) a.node[u(next[u(e.first)]++)] = e.second, a.node[u(next[u(e.second)]++)] = e.first;
  Int out = 0;
  for (Int n = 0, from = 0; n < nodes; ++n) {
    const Int to = a.start[u(n) + 1];
    std::sort(a.node.begin() + from, a.node.begin() + to);
    const Int begin = out;
    for (Int e = from; e < to; ++e)
      if (out == begin || a.node[u(out - 1)] != a.node[u(e)]) a.node[u(out++)] = a.node[u(e)];
    from = to;
    a.start[u(n)] = begin;
  }
  a.start[u(nodes)] = out;
  a.node.resize(u(out));
  return a;
}

std::vector<Int> order_nodes(Int nodes, Adjacency& a) {
  std::vector<Int> node_at(u(nodes));
  std::iota(node_at.begin(), node_at.end(), 0);
  if (nodes < 2 || a.node.empty()) return node_at;
  if (nodes >= kNestedDissectionFrom) {
    keep_libraries_to_one_thread();
    idx_t options[METIS_NOPTIONS];
    METIS_SetDefaultOptions(options);
    options[METIS_OPTION_SEED] = 1;
    options[METIS_OPTION_NSEPS] = 1;
    std::vector<idx_t> inverse(u(nodes));
    idx_t n = nodes;
    if (METIS_NodeND(&n, a.start.data(), a.node.data(), nullptr, options, node_at.data(), inverse.data()) != METIS_OK)
      throw std::runtime_error("METIS_NodeND failed");
  } else {
    double control[AMD_CONTROL], info[AMD_INFO];
    amd_defaults(control);
    if (amd_order(nodes, a.start.data(), a.node.data(), node_at.data(), control, info) < 0)
      throw std::runtime_error("amd_order failed");
  }
  return node_at;
}

// Elimination tree by Liu's algorithm with path compression; parent[] in positions.
std::vector<Int> tree_parents(const Adjacency& a, const std::vector<Int>& node_at, const std::vector<Int>& position) {
  const Int n = static_cast<Int>(node_at.size());
  std::vector<Int> parent(u(n), -1), ancestor(u(n), -1);
  for (Int j = 0; j < n; ++j) {
    const Int node = node_at[u(j)];
    for (Int e = a.start[u(node)]; e < a.start[u(node) + 1]; ++e) {
      for (Int i = position[u(a.node[u(e)])]; i < j && i >= 0;) {
        const Int up = ancestor[u(i)];
        ancestor[u(i)] = j;
        if (up < 0) parent[u(i)] = j;
        i = up == j ? -1 : up;
      }
    }
  }
  return parent;
}

// Postorder in which the child with the deepest subtree comes last, next to its parent.
std::vector<Int> postorder(const std::vector<Int>& parent) {
  const Int n = static_cast<Int>(parent.size());
  std::vector<Int> weight(u(n), 1), first_child(u(n), -1), sibling(u(n), -1), order;
  for (Int j = 0; j < n; ++j)
    if (parent[u(j)] >= 0) weight[u(parent[u(j)])] += weight[u(j)];
  std::vector<Int> heaviest(u(n), -1);
  for (Int j = 0; j < n; ++j)
    if (const Int p = parent[u(j)]; p >= 0 && (heaviest[u(p)] < 0 || weight[u(heaviest[u(p)])] < weight[u(j)]))
      heaviest[u(p)] = j;
  for (Int j = n - 1; j >= 0; --j)  // lists begin with the light children, the heaviest is appended when visiting
    if (const Int p = parent[u(j)]; p >= 0 && heaviest[u(p)] != j)
      sibling[u(j)] = first_child[u(p)], first_child[u(p)] = j;
  order.reserve(u(n));
  std::vector<std::pair<Int, bool>> stack;
  for (Int root = n - 1; root >= 0; --root)
    if (parent[u(root)] < 0) stack.push_back({root, false});
  while (!stack.empty()) {
    const auto [j, expanded] = stack.back();
    stack.pop_back();
    if (expanded) {
      order.push_back(j);
      continue;
    }
    stack.push_back({j, true});
    if (heaviest[u(j)] >= 0) stack.push_back({heaviest[u(j)], false});
    for (Int c = first_child[u(j)]; c >= 0; c = sibling[u(c)]) stack.push_back({c, false});
  }
  return order;
}

// Merging a child into its parent is worth some explicit zeros when the front is small.
bool worth_merging(std::size_t child_columns, std::size_t child_below, std::size_t columns, std::size_t below) {
  const std::size_t merged_front = child_columns + columns + below;
  const std::size_t zeros = child_columns * (columns + below - child_below);  // blocks added to the child's columns
  if (zeros == 0) return true;
  const std::size_t total = (child_columns + columns) * merged_front;
  return child_columns + columns <= 4    ? 3 * zeros <= total
         : child_columns + columns <= 16 ? 8 * zeros <= total
                                         : 20 * zeros <= total;
}

}  // namespace

EliminationTree elimination_tree(Int nodes, const std::vector<std::pair<Int, Int>>& edges, Int last_node) {
  EliminationTree tree;
  {
    Adjacency inner = adjacency(nodes, edges, last_node);
    tree.node_at = order_nodes(nodes, inner);
  }
  if (last_node >= 0) {
    std::erase(tree.node_at, last_node);
    tree.node_at.push_back(last_node);
  }
  const Adjacency graph = adjacency(nodes, edges, -1);
  const auto invert = [&] {
    tree.position.assign(u(nodes), 0);
    for (Int p = 0; p < nodes; ++p) tree.position[u(tree.node_at[u(p)])] = p;
  };
  invert();
  std::vector<Int> parent = tree_parents(graph, tree.node_at, tree.position);
  {
    const std::vector<Int> order = postorder(parent);
    std::vector<Int> renumbered(u(nodes)), moved_parent(u(nodes), -1), moved_nodes(u(nodes));
    for (Int p = 0; p < nodes; ++p) renumbered[u(order[u(p)])] = p;
    for (Int p = 0; p < nodes; ++p) {
      const Int old = order[u(p)];
      moved_nodes[u(p)] = tree.node_at[u(old)];
      if (parent[u(old)] >= 0) moved_parent[u(p)] = renumbered[u(parent[u(old)])];
    }
    tree.node_at = std::move(moved_nodes);
    parent = std::move(moved_parent);
    invert();
  }

  // Structures bottom-up; a supernode grows as long as its last child (the position before) merges into it.
  std::vector<std::vector<Int>> pending(u(nodes));  // supernodes that hang below a position
  tree.supernode_of.assign(u(nodes), -1);
  std::vector<char> dead;
  std::vector<Int> mark(u(nodes), -1);
  for (Int j = 0; j < nodes; ++j) {
    Supernode s;
    s.first = j, s.last = j + 1;
    const auto visit = [&](Int p) {
      if (p > j && mark[u(p)] != j) mark[u(p)] = j, s.below.push_back(p);
    };
    const Int node = tree.node_at[u(j)];
    for (Int e = graph.start[u(node)]; e < graph.start[u(node) + 1]; ++e) visit(tree.position[u(graph.node[u(e)])]);
    for (Int child : pending[u(j)])
      for (Int p : tree.supernodes[u(child)].below) visit(p);
    std::sort(s.below.begin(), s.below.end());
    if (!pending[u(j)].empty()) {
      const Int last = pending[u(j)].back();
      Supernode& c = tree.supernodes[u(last)];
      if (c.last == j && worth_merging(u(c.last - c.first), c.below.size(), 1, s.below.size())) {
        c.last = j + 1;
        c.below = std::move(s.below);
        pending[u(j)].pop_back();
        if (!c.below.empty()) pending[u(c.below.front())].push_back(last);
        tree.supernode_of[u(j)] = last;
        continue;
      }
    }
    const Int me = static_cast<Int>(tree.supernodes.size());
    tree.supernode_of[u(j)] = me;
    if (!s.below.empty()) pending[u(s.below.front())].push_back(me);
    tree.supernodes.push_back(std::move(s));
  }
  // A merged supernode keeps its child's place, so children still precede parents; roots of separate parts have none.
  for (Supernode& s : tree.supernodes)
    if (!s.below.empty()) s.parent = tree.supernode_of[u(s.below.front())];
  return tree;
}

}  // namespace isostat
