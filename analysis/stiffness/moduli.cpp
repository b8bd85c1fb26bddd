#include "analysis/stiffness/moduli.hpp"

#include "analysis/rigidity/area_rows.hpp"
#include "analysis/rigidity/independent_columns.hpp"
#include "analysis/stiffness/pseudo_inverse.hpp"
#include "analysis/stiffness/stiffness_matrix.hpp"
#include "dem/state/link_ends.hpp"

namespace isostat {
namespace {

// Link velocities of unit strains with the grains held: affine relative velocity -e r of the branch vectors.
std::array<std::vector<double>, 3> strain_velocities(const LinkNetwork& network, const RigidityMatrix& g) {
  const Packing<2>& packing = network.packing;
  std::array<std::vector<double>, 3> s;
  for (auto& v : s) v.resize(static_cast<std::size_t>(g.rows()));
  for (std::size_t row = 0; row < s[0].size(); ++row) {
    const auto l = static_cast<std::size_t>(g.link_of_row[row]);
    if (network.is_area(l)) {
      for (const auto& [body, shift, at] : area_loads(network, network.area(l), g.kind[row] == RowKind::tangential)) {
        const Vec2 x = packing.bodies.position[static_cast<std::size_t>(body)] + packing.cell->offset(shift);
        s[0][row] -= at[0] * x[0], s[1][row] -= at[1] * x[1], s[2][row] -= 0.5 * (at[0] * x[1] + at[1] * x[0]);
      }
      continue;
    }
    const Link<2>& link = packing.links[l];
    const LinkEnds<2> at = ends(packing, link);
    const Vec2& r = at.branch;
    const LinkFrame<double> f = frame(at);
    const std::array<Vec2, 3> affine = {Vec2{{-r[0], 0}}, Vec2{{0, -r[1]}}, Vec2{{-0.5 * r[1], -0.5 * r[0]}}};
    for (std::size_t b = 0; b < 3; ++b) {
      const auto v = link_velocity(f, affine[b][0], affine[b][1], 0.0, 0.0);
      s[b][row] = ByRow<double>{v.normal, v.tangential, v.rolling}[g.kind[row]];
    }
  }
  return s;
}

}  // namespace

ElasticResponse<3> elastic_response(const LinkNetwork& network, NetworkLaw network_law, const DiskLaw& law) {
  RigidityMatrix g = rigidity_matrix(network, network_law, false);
  std::vector<double> k = row_stiffness(network, g, law);
  bool definite = true;
  for (double v : k) definite = definite && v > 0;
  const PseudoInverse inverse(weighted_normal_matrix(g, k), dependent_columns(network, network_law, false),
                              definite ? SparseCholesky::Form::definite : SparseCholesky::Form::indefinite);
  const auto strain = strain_velocities(network, g);
  return elastic_response(std::move(g), std::move(k), inverse, strain, network.packing.cell->measure());
}

}  // namespace isostat
