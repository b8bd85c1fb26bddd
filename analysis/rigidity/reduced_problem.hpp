// The elimination problem that stands behind rank, floppy modes and self-stress: contracted, pruned, ordered.
#pragma once
#include <memory>

#include "analysis/rigidity/body_network.hpp"
#include "analysis/rigidity/modular_ldlt.hpp"

namespace isostat {

template <class F>
struct ReducedProblem {
  RigidBodies bodies;
  Rows<F> rows;
  PrunedNetwork network;
  EliminationTree tree;
  std::vector<std::int32_t> node_of_body;  // -1 for pruned bodies and bodies without rows; the strain is the last body
  std::vector<std::int32_t> body_of_node;
  std::vector<std::int8_t> dofs;  // by node
  std::int64_t free_bodies = 0;   // bodies left without any row
  int per_body = 3;
  double contraction_seconds = 0, assembly_seconds = 0, ordering_seconds = 0;

  std::int32_t strain_node() const { return node_of_body.back(); }  // -1: a fixed cell
  // The rows for ModularLdlt; they may come from another field or geometry of the same packing.
  template <class G>
  NodeRows<G> node_rows(const Rows<G>& of) const {
    return {of, network.rows, node_of_body};
  }
};

template <class F>
ReducedProblem<F> reduce_problem(const LinkNetwork& network, NetworkLaw law, bool cell_free);

}  // namespace isostat
