#include "analysis/rigidity/reduced_problem.hpp"

#include "analysis/rigidity/rigid_spheres.hpp"
#include "dem/solver/clocks.hpp"
#include "geometry/base/index.hpp"

namespace isostat {

template <class F, class Network>
ReducedProblem<F, Network> reduce_problem(const Network& network, NetworkLaw law, bool cell_free) {
  constexpr int kMost = kMostDofs<Network>;
  ReducedProblem<F, Network> p;
  p.per_body = dof_layout(network, law, cell_free).per_body;

  double start = wall_seconds();
  p.bodies = contract_rigid_bodies(network, law);
  p.contraction_seconds = wall_seconds() - start;

  start = wall_seconds();
  p.rows = body_rows<F>(network, law, cell_free, p.bodies, exact_geometry<F>(network));
  p.network = prune(p.rows, p.bodies.count, p.per_body);
  p.assembly_seconds = wall_seconds() - start;

  start = wall_seconds();
  const auto bodies = idx(p.bodies.count);
  p.node_of_body.assign(bodies + 1, -1);
  std::vector<char> touched(bodies + 1, 0);
  for (std::int32_t r : p.network.rows)
    for (const RowBlock<F, kMost>& block : p.rows.of(idx(r))) touched[idx(block.body)] = 1;
  const auto add_node = [&](std::int32_t body, int dofs) {
    p.node_of_body[idx(body)] = static_cast<std::int32_t>(p.body_of_node.size());
    p.body_of_node.push_back(body);
    p.dofs.push_back(static_cast<std::int8_t>(dofs));
  };
  for (std::int32_t b : p.network.bodies) {
    if (touched[idx(b)])
      add_node(b, p.per_body);
    else
      ++p.free_bodies;
  }
  if (cell_free) add_node(p.bodies.count, kDimension<Network>);

  std::vector<std::pair<std::int32_t, std::int32_t>> edges;
  edges.reserve(p.network.rows.size());
  for (std::int32_t r : p.network.rows) {
    const auto blocks = p.rows.of(idx(r));
    for (std::size_t a = 0; a < blocks.size(); ++a)
      for (std::size_t b = a + 1; b < blocks.size(); ++b) {
        const std::pair edge = {p.node_of_body[idx(blocks[a].body)], p.node_of_body[idx(blocks[b].body)]};
        if (edges.empty() || edges.back() != edge) edges.push_back(edge);
      }
  }
  p.tree = elimination_tree(static_cast<std::int32_t>(p.dofs.size()), edges, p.strain_node());
  p.ordering_seconds = wall_seconds() - start;
  return p;
}

template ReducedProblem<FirstField, LinkNetwork> reduce_problem(const LinkNetwork&, NetworkLaw, bool);
template ReducedProblem<WideField, LinkNetwork> reduce_problem(const LinkNetwork&, NetworkLaw, bool);
template ReducedProblem<FirstField, SphereNetwork> reduce_problem(const SphereNetwork&, NetworkLaw, bool);
template ReducedProblem<WideField, SphereNetwork> reduce_problem(const SphereNetwork&, NetworkLaw, bool);

}  // namespace isostat
