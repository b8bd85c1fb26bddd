// The elimination problem that stands behind rank, floppy modes and self-stress: contracted, pruned, ordered.
#pragma once
#include <memory>

#include "analysis/rigidity/body_network.hpp"
#include "analysis/rigidity/modular_ldlt.hpp"

namespace isostat {

template <class F>
struct ReducedProblem {
  RigidBodies bodies;
  std::vector<BodyRow<F>> rows;
  PrunedNetwork network;
  EliminationTree tree;
  std::vector<std::int32_t> node_of_body;  // -1 for pruned bodies and bodies without rows
  std::vector<std::int32_t> body_of_node;  // the strain node, if any, is the last: -1
  std::vector<std::int8_t> dofs;           // by node
  std::int64_t free_bodies = 0;            // bodies left without any row
  std::int32_t strain_node = -1;
  int per_body = 3;
  double contraction_seconds = 0, assembly_seconds = 0, ordering_seconds = 0;
};

template <class F>
ReducedProblem<F> reduce_problem(const Packing<2>& packing, NetworkLaw law, bool cell_free);

// Rows of the network in the form that ModularLdlt takes; `rows` may come from another field or geometry.
template <class F, class G>
std::vector<FieldRow<G>> field_rows(const ReducedProblem<F>& problem, const std::vector<BodyRow<G>>& rows) {
  std::vector<FieldRow<G>> result;
  result.reserve(problem.network.rows.size());
  for (std::int32_t r : problem.network.rows) {
    const BodyRow<G>& row = rows[static_cast<std::size_t>(r)];
    FieldRow<G> f;
    f.node[0] = problem.node_of_body[static_cast<std::size_t>(row.a)];
    f.value[0] = row.at_a;
    if (row.b != row.a) f.node[1] = problem.node_of_body[static_cast<std::size_t>(row.b)], f.value[1] = row.at_b;
    if (problem.strain_node >= 0 && !(row.at_strain[0].is_zero() && row.at_strain[1].is_zero())) {
      f.node[2] = problem.strain_node;
      f.value[2] = {row.at_strain[0], row.at_strain[1], G{}};
    }
    result.push_back(f);
  }
  return result;
}

}  // namespace isostat
