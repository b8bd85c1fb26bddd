// Order of elimination and its symbolic factorisation on the graph of bodies: which blocks fill in, grouped into
// supernodes for a multifrontal factorisation. Depends on the topology only, so one serves any field and geometry.
#pragma once
#include <cstdint>
#include <utility>
#include <vector>

namespace isostat {

struct Supernode {
  std::int32_t first = 0, last = 0;  // nodes [first, last) in the order of elimination
  std::int32_t parent = -1;          // supernode, -1 for a root
  std::vector<std::int32_t> below;   // further nodes of its front, ascending positions
};

struct EliminationTree {
  std::vector<std::int32_t> node_at;       // position -> node
  std::vector<std::int32_t> position;      // node -> position
  std::vector<Supernode> supernodes;       // in postorder: children come before their parent
  std::vector<std::int32_t> supernode_of;  // position -> supernode
};

// Graph of `nodes` nodes with undirected edges (repeats and loops allowed). If last_node >= 0, that node (the strain
// of the cell, joined to many) is eliminated last. Nested dissection (METIS, fixed seed) for large graphs, minimum
// degree (AMD) for small ones.
EliminationTree elimination_tree(std::int32_t nodes, const std::vector<std::pair<std::int32_t, std::int32_t>>& edges,
                                 std::int32_t last_node = -1);
inline constexpr std::int32_t kNestedDissectionFrom = 20000;  // nodes; below, AMD orders faster than it loses

}  // namespace isostat
