#include "analysis/rigidity/independent_columns.hpp"

#include <numeric>

#include "analysis/rigidity/reduced_problem.hpp"
#include "dem/input_error.hpp"

namespace isostat {

// The unknowns of body_rows are V at the origin of the frame and W, those of G the velocity of the centre and w:
// column w of G is column W plus columns V of the same body, eliminated just before. Likewise peculiar and absolute
// velocities differ by columns V in the strain columns, which come last. So the same columns depend on earlier ones.
std::vector<char> dependent_columns(const Packing<2>& packing, NetworkLaw law, bool cell_free) {
  if (cell_free && !packing.cell) throw InputError("command line", 0, "--cell", "free", "the input has no cell");
  using F = FirstField;
  const RigidBodies grains = contract_rigid_bodies(packing, NetworkLaw::frictionless);  // no contraction
  const auto rows = body_rows(packing, law, cell_free, grains, exact_geometry<F>(packing));
  const DofLayout layout = dof_layout(packing.bodies.size(), law, cell_free);
  const auto n = static_cast<std::int32_t>(packing.bodies.size());
  const std::int32_t strain_node = cell_free ? n : -1;

  std::vector<std::int8_t> dofs(packing.bodies.size(), static_cast<std::int8_t>(layout.per_body));
  if (cell_free) dofs.push_back(2);
  std::vector<std::pair<std::int32_t, std::int32_t>> edges;
  std::vector<FieldRow<F>> field;
  edges.reserve(rows.size()), field.reserve(rows.size());
  for (const auto& row : rows) {
    FieldRow<F> f;
    f.node[0] = row.a, f.value[0] = row.at_a;
    if (row.b != row.a) f.node[1] = row.b, f.value[1] = row.at_b;
    edges.push_back({row.a, row.b});
    if (cell_free && !(row.at_strain[0].is_zero() && row.at_strain[1].is_zero())) {
      f.node[2] = strain_node, f.value[2] = {row.at_strain[0], row.at_strain[1], F{}};
      edges.push_back({row.a, strain_node});
      edges.push_back({row.b, strain_node});
    }
    field.push_back(f);
  }
  const EliminationTree tree = elimination_tree(static_cast<std::int32_t>(dofs.size()), edges, strain_node);
  for (std::uint64_t attempt = 0;; ++attempt) {
    try {
      return ModularLdlt<F>(tree, dofs, field, 77 + attempt, false).dependent();
    } catch (const RandomizationFailed&) {
      if (attempt == 3) throw;
    }
  }
}

}  // namespace isostat
