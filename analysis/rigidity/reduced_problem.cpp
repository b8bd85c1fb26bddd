#include "analysis/rigidity/reduced_problem.hpp"

#include <chrono>

namespace isostat {

template <class F>
ReducedProblem<F> reduce_problem(const Packing<2>& packing, NetworkLaw law, bool cell_free) {
  using Clock = std::chrono::steady_clock;
  const auto seconds = [](Clock::time_point from) {
    return std::chrono::duration<double>(Clock::now() - from).count();
  };
  ReducedProblem<F> p;
  p.per_body = law == NetworkLaw::frictionless ? 2 : 3;

  auto start = Clock::now();
  p.bodies = contract_rigid_bodies(packing, law);
  p.contraction_seconds = seconds(start);

  start = Clock::now();
  p.rows = body_rows(packing, law, cell_free, p.bodies, exact_geometry<F>(packing));
  p.network = prune(p.rows, p.bodies.count, p.per_body);
  p.assembly_seconds = seconds(start);

  start = Clock::now();
  p.node_of_body.assign(static_cast<std::size_t>(p.bodies.count), -1);
  std::vector<char> touched(static_cast<std::size_t>(p.bodies.count), 0);
  for (std::int32_t r : p.network.rows) {
    touched[static_cast<std::size_t>(p.rows[static_cast<std::size_t>(r)].a)] = 1;
    touched[static_cast<std::size_t>(p.rows[static_cast<std::size_t>(r)].b)] = 1;
  }
  for (std::int32_t b : p.network.bodies) {
    if (!touched[static_cast<std::size_t>(b)]) {
      ++p.free_bodies;
      continue;
    }
    p.node_of_body[static_cast<std::size_t>(b)] = static_cast<std::int32_t>(p.body_of_node.size());
    p.body_of_node.push_back(b);
    p.dofs.push_back(static_cast<std::int8_t>(p.per_body));
  }
  if (cell_free) {
    p.strain_node = static_cast<std::int32_t>(p.body_of_node.size());
    p.body_of_node.push_back(-1);
    p.dofs.push_back(2);
  }
  // The strain node is joined by topology (a row through an image), so that any geometry fits.
  std::vector<std::pair<std::int32_t, std::int32_t>> edges;
  edges.reserve(p.network.rows.size());
  for (std::int32_t r : p.network.rows) {
    const BodyRow<F>& row = p.rows[static_cast<std::size_t>(r)];
    const std::int32_t a = p.node_of_body[static_cast<std::size_t>(row.a)],
                       b = p.node_of_body[static_cast<std::size_t>(row.b)];
    if (edges.empty() || edges.back() != std::pair{a, b}) edges.push_back({a, b});
    if (p.strain_node >= 0 && p.bodies.image(packing.links[static_cast<std::size_t>(row.link)]) != ImageShift<2>{}) {
      const auto link_edge = edges.back();
      edges.push_back({a, p.strain_node});
      if (b != a) edges.push_back({b, p.strain_node});
      edges.push_back(link_edge);
    }
  }
  p.tree = elimination_tree(static_cast<std::int32_t>(p.dofs.size()), edges, p.strain_node);
  p.ordering_seconds = seconds(start);
  return p;
}

template ReducedProblem<FirstField> reduce_problem(const Packing<2>&, NetworkLaw, bool);
template ReducedProblem<WideField> reduce_problem(const Packing<2>&, NetworkLaw, bool);

}  // namespace isostat
