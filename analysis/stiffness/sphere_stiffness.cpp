#include "analysis/stiffness/sphere_stiffness.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/rigidity/independent_columns.hpp"
#include "analysis/rigidity/link_rows_3d.hpp"
#include "analysis/stiffness/lowest_modes.hpp"
#include "analysis/stiffness/pseudo_inverse.hpp"
#include "analysis/stiffness/stiffness_matrix.hpp"
#include "analysis/vector_algebra.hpp"
#include "dem/input_error.hpp"
#include "dem/spheres/at_rest.hpp"
#include "dem/state/link_ends.hpp"
#include "geometry/base/index.hpp"

namespace isostat {
namespace {

using Vector = std::vector<double>;

bool all_positive(const Vector& k) {
  return std::all_of(k.begin(), k.end(), [](double v) { return v > 0; });
}

// Rows e_a . (v_j - v_i) of the centres times the square root of 1 - n n, which is itself: three a link.
void add_geometric_rows(RigidityMatrix& g, Vector& weight, const SphereNetwork& network,
                        const std::vector<SphereStiffness>& stiffness, bool cell_free) {
  for (std::size_t l = 0; l < network.links(); ++l) {
    const Link<3>& link = network.packing.links[l];
    if (stiffness[l].prestress == 0) continue;
    const LinkEnds<3> where = ends(network.packing, link);
    const LinkFrame3<double> f = frame(where);
    for (int a = 0; a < 3; ++a) {
      Vec3 across = -f.n[idx(a)] * Vec3{f.n};
      across[a] += 1;
      const auto add_body = [&](std::int32_t body, double sign) {
        for (int d = 0; network.is_free(body) && d < 3; ++d)
          g.column.push_back(g.layout.per_body * static_cast<std::int64_t>(body) + d),
              g.value.push_back(sign * across[d]);
      };
      if (link.i != link.j) {
        const double sign = link.i < link.j ? -1 : 1;
        add_body(std::min(link.i, link.j), sign), add_body(std::max(link.i, link.j), -sign);
      }
      for (int d = 0; cell_free && d < 3; ++d)
        g.column.push_back(g.layout.strain_column(d)), g.value.push_back(-across[d] * where.branch[d]);
      g.row_start.push_back(static_cast<std::int64_t>(g.column.size()));
      weight.push_back(-stiffness[l].prestress / f.distance);
    }
  }
}

}  // namespace

UniformStiffness network_stiffness(const Packing<3>& packing, const std::vector<double>& given) {
  double largest_radius = 0;
  for (const double r : packing.bodies.radius) largest_radius = std::max(largest_radius, r);
  UniformStiffness k;
  if (!given.empty()) k.normal = given[0];
  k.tangential = given.size() > 1 ? given[1] : k.normal;
  k.rolling = given.size() > 2 ? given[2] : 1e-4 * k.normal * 4 * largest_radius * largest_radius;
  k.distant = -1e-2 * k.normal;
  return k;
}

std::vector<SphereStiffness> by_link(const Packing<3>& packing, const UniformStiffness& k) {
  std::vector<SphereStiffness> all;
  for (const Link<3>& link : packing.links) {
    if (link.kind == LinkKind::distant)
      all.push_back({k.distant, 0, 0, link.normal_force});
    else
      all.push_back({k.normal, k.tangential, k.rolling, link.normal_force});
  }
  return all;
}

std::vector<SphereStiffness> by_link(const SpherePacking& packing, const SphereLaw& law) {
  std::vector<SphereStiffness> all;
  for (const Link<3>& link : packing.links) {
    const ContactStiffness c = pair_stiffness(law, body_of(packing, link.i), body_of(packing, link.j));
    all.push_back({at_rest(law, c, link.gap).stiffness, tangential_stiffness(law, c, link.gap),
                   link.kind == LinkKind::distant ? 0.0 : law.rolling_stiffness, link.normal_force});
  }
  return all;
}

std::vector<double> row_stiffness(const RigidityMatrix& g, const std::vector<SphereStiffness>& stiffness) {
  Vector k(idx(g.rows()));
  for (std::size_t r = 0; r < k.size(); ++r) {
    const SphereStiffness& of = stiffness[idx(g.link_of_row[r])];
    k[r] = ByRow<double>{of.normal, of.tangential, of.rolling}[g.kind[r]];
  }
  return k;
}

SymmetricMatrix stiffness_matrix(const SphereNetwork& network, NetworkLaw law, bool cell_free,
                                 const std::vector<SphereStiffness>& stiffness, bool geometric) {
  RigidityMatrix g = in_contact_frames(network, rigidity_matrix(network, law, cell_free));
  Vector k = row_stiffness(g, stiffness);
  if (geometric) add_geometric_rows(g, k, network, stiffness, cell_free);
  return weighted_normal_matrix(g, k);
}

ElasticResponse<6> elastic_response(const SphereNetwork& network, NetworkLaw law,
                                    const std::vector<SphereStiffness>& stiffness) {
  RigidityMatrix g = in_contact_frames(network, rigidity_matrix(network, law, false));
  Vector k = row_stiffness(g, stiffness);
  const PseudoInverse inverse(weighted_normal_matrix(g, k), dependent_columns(network, law, false),
                              all_positive(k) ? SparseCholesky::Form::definite : SparseCholesky::Form::indefinite);
  // Link velocities of unit strains with the grains held: the centres move apart by -e r.
  std::array<Vector, 6> strain;
  for (auto& s : strain) s.assign(k.size(), 0.0);
  for (std::size_t r = 0; r < k.size(); ++r) {
    if (g.kind[r] == RowKind::rolling) continue;
    const Link<3>& link = network.packing.links[idx(g.link_of_row[r])];
    const Vec3 b = ends(network.packing, link).branch, axis = axis_in_frame(network, g, r);
    for (std::size_t e = 0; e < 3; ++e) {
      const int d = static_cast<int>(e), p = (d + 1) % 3, q = (d + 2) % 3;
      strain[e][r] = -axis[d] * b[d];
      strain[3 + e][r] = -0.5 * (axis[p] * b[q] + axis[q] * b[p]);
    }
  }
  return elastic_response(std::move(g), std::move(k), inverse, strain, network.packing.cell->measure());
}

std::vector<double> dof_masses(const SphereNetwork& network, NetworkLaw law) {
  const Bodies<3>& bodies = network.packing.bodies;
  const int per_body = dof_layout(network, law, false).per_body;
  Vector mass;
  for (std::size_t i = 0; i < idx(network.free); ++i) {
    if (!(bodies.mass[i] > 0) || !(bodies.inertia[i] > 0))
      throw InputError("bodies", 0, "mass", std::to_string(bodies.mass[i]),
                       "vibrations need positive masses and inertias");
    mass.insert(mass.end(), 3, bodies.mass[i]);
    if (per_body == 6) mass.insert(mass.end(), 3, bodies.inertia[i]);
  }
  return mass;
}

VibrationModes vibration_modes(const SphereNetwork& network, NetworkLaw law,
                               const std::vector<SphereStiffness>& stiffness, int count, bool displacements) {
  const Vector mass = dof_masses(network, law);
  const RigidityMatrix g = in_contact_frames(network, rigidity_matrix(network, law, false));
  const Vector k = row_stiffness(g, stiffness);
  const std::vector<char> dependent = dependent_columns(network, law, false);
  VibrationModes modes;
  modes.per_body = g.layout.per_body;
  modes.zero_modes = std::count(dependent.begin(), dependent.end(), 1);
  take_modes(modes, lowest_modes(weighted_normal_matrix(g, k), dependent, mass, count, all_positive(k), true), mass,
             displacements);
  return modes;
}

}  // namespace isostat
