// The elimination problem that stands behind rank, floppy modes and self-stress: contracted, pruned, ordered.
#pragma once
#include <memory>

#include "analysis/rigidity/body_network.hpp"
#include "analysis/rigidity/modular_ldlt.hpp"
#include "analysis/rigidity/sphere_rows.hpp"

namespace isostat {

// What depends on the dimension, by the type of the network.
template <class Network>
inline constexpr int kMostDofs = 3;
template <>
inline constexpr int kMostDofs<SphereNetwork> = kSphereDofs;
template <class Network>
inline constexpr int kDimension = 2;
template <>
inline constexpr int kDimension<SphereNetwork> = 3;

template <class F, class Network = LinkNetwork>
struct ReducedProblem {
  static constexpr int kMost = kMostDofs<Network>;
  RigidBodiesOf<kDimension<Network>> bodies;
  Rows<F, kMost> rows;
  PrunedNetwork<kMost> network;
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
  NodeRows<G, kMost> node_rows(const Rows<G, kMost>& of) const {
    return {of, network.rows, node_of_body};
  }
};

template <class F, class Network>
ReducedProblem<F, Network> reduce_problem(const Network& network, NetworkLaw law, bool cell_free);

}  // namespace isostat
