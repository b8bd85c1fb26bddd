#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/network/force_scale.hpp"
#include "analysis/rigidity/exact_rank.hpp"
#include "analysis/rigidity/independent_columns.hpp"
#include "analysis/rigidity/sections.hpp"
#include "analysis/stiffness/density_of_states.hpp"
#include "analysis/stiffness/moduli.hpp"
#include "analysis/stiffness/prestressed_modes.hpp"
#include "analysis/stiffness/pseudo_inverse.hpp"
#include "analysis/stiffness/sphere_stiffness.hpp"
#include "analysis/stiffness/stiff_rows.hpp"
#include "analysis/stiffness/stiffness_matrix.hpp"
#include "analysis/stiffness/vibration.hpp"
#include "dem/disks/at_rest.hpp"

namespace isostat {
namespace {

using Json = nlohmann::ordered_json;
constexpr int kTabulatedModes = 100;

// Of a state of spheres each contact has its own: the means over contacts, and over distant links.
Json mean_stiffness(const AnalysisInput& input) {
  SphereStiffness sum;
  double contacts = 0, gaps = 0, distant = 0;
  const std::vector<SphereStiffness> all = by_link(*input.packing_3d, input.spheres_state->law);
  for (std::size_t l = 0; l < all.size(); ++l) {
    if (!is_contact(input.packing_3d->links[l].kind)) {
      ++gaps, distant += all[l].normal;
      continue;
    }
    ++contacts, sum.normal += all[l].normal, sum.tangential += all[l].tangential, sum.rolling += all[l].rolling;
  }
  const auto mean = [](double total, double n) { return n > 0 ? Json(total / n) : Json(nullptr); };
  return {{"normal", mean(sum.normal, contacts)},
          {"tangential", mean(sum.tangential, contacts)},
          {"rolling", mean(sum.rolling, contacts)},
          {"distant", mean(distant, gaps)}};
}

Json stiffness_values(const AnalysisInput& input, const AnalysisOptions& options) {
  if (input.spheres_state) return mean_stiffness(input);
  if (input.packing_3d) {
    const UniformStiffness k = network_stiffness(*input.packing_3d, options.stiffness);
    return {{"normal", k.normal}, {"tangential", k.tangential}, {"rolling", k.rolling}, {"distant", k.distant}};
  }
  if (input.triangles) {
    const TriangleLaw& t = input.triangles->law;
    return {{"modulus", t.modulus},
            {"overlap_length", t.overlap_length > 0 ? Json(t.overlap_length) : Json(nullptr)},
            {"tangential", t.tangential_stiffness}};
  }
  const DiskLaw law = law_of(input, options);
  return {{"normal", law.normal_stiffness},
          {"tangential", law.tangential_stiffness},
          {"rolling", law.rolling_stiffness},
          {"distant", law.attraction_range > 0 ? Json(distant(law, 0).stiffness) : Json(nullptr)}};
}

// With the assumption that a packing without a law needs: results are proportional to it.
Json stiffness_of(const AnalysisInput& input, const AnalysisOptions& options) {
  Json json = stiffness_values(input, options);
  if (!input.has_law())
    json["assumed"] = options.stiffness.empty()
                          ? "the packing brings no law, these are defaults; give its own by --stiffness"
                          : "the packing brings no law, --stiffness gives it these";
  return json;
}

std::string explain_floppy(const ExactRank& r) {
  if (r.mechanisms == 0) return "rigid: no mechanism beyond the trivial motions and the rattlers";
  return "floppy: K = " + std::to_string(r.floppy) + ", " + std::to_string(r.mechanisms) + " mechanisms, see clusters";
}

Json matrix(const Moduli& m) {
  Json rows = Json::array();
  for (const auto& row : m) rows.push_back({row[0], row[1], row[2]});
  return rows;
}

// Isotropic part and its failure: K = (C11 + C22 + 2 C12) / 4, shear modulus under pure shear (C11 + C22 - 2 C12) / 4
// and under gamma12.
Json described(const Moduli& m) {
  const double bulk = (m[0][0] + m[1][1] + m[0][1] + m[1][0]) / 4, pure = (m[0][0] + m[1][1] - m[0][1] - m[1][0]) / 4;
  const double shear = m[2][2], sum = pure + shear;
  return {{"tensor", matrix(m)},
          {"bulk", bulk},
          {"pure_shear", pure},
          {"shear", shear},
          {"anisotropy", sum > 0 ? Json((pure - shear) / sum) : Json(nullptr)}};
}

// Of spheres: bulk modulus and shear modulus by Voigt's averages over directions, K = sum of C_ab over a, b <= 3, by 9.
Json described(const SphereModuli& m) {
  Json rows = Json::array();
  for (const auto& row : m) rows.push_back(row);
  double bulk = 0, diagonal = 0, shear = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t b = 0; b < 3; ++b) bulk += m[a][b] / 9;
    diagonal += m[a][a], shear += m[3 + a][3 + a];
  }
  return {{"tensor", rows}, {"bulk", bulk}, {"shear", (diagonal - 3 * bulk) / 10 + shear / 5}};
}

Json described(const EnergyShares& e) {
  const auto number = [](double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); };
  return {{"normal", number(e.normal)},
          {"tangential", number(e.tangential)},
          {"rolling", number(e.rolling)},
          {"distant", number(e.distant)},
          {"participation", number(e.participation)}};
}

// Of an isotropic compression, and of the shear angles (in space all three, their energies added).
template <std::size_t N>
Json energy_json(const ElasticResponse<N>& response, const std::vector<bool>& contact) {
  constexpr std::size_t d = N == 3 ? 2 : 3;
  std::array<double, N> bulk{};
  std::vector<std::array<double, N>> shear(N - d);
  for (std::size_t a = 0; a < d; ++a) bulk[a] = 1;
  for (std::size_t a = 0; a < N - d; ++a) shear[a][d + a] = 1;
  return {{"bulk", described(energy_shares(response, contact, {bulk}))},
          {"shear", described(energy_shares(response, contact, shear))}};
}

// The moduli, what they would be if no grain left the affine motion, and where the energy sits.
template <std::size_t N>
void add_response(Json& section, const ElasticResponse<N>& response, const std::vector<bool>& contact) {
  const Json values = described(response.tensor), affine = described(response.affine);
  for (const auto& [key, value] : values.items()) section[key] = value;
  section["affine"] = affine;
  const auto over = [&](const char* key) {
    const double held = affine[key];
    return held > 0 ? Json(values[key].template get<double>() / held) : Json(nullptr);
  };
  section["over_affine"] = {{"bulk", over("bulk")}, {"shear", over("shear")}};
  section["energy"] = energy_json(response, contact);
}

std::vector<bool> contacts_of(const LinkNetwork& network) {
  std::vector<bool> contact(network.links(), true);  // an overlap of triangles is one
  for (std::size_t l = 0; l < network.packing.links.size(); ++l)
    contact[l] = network.packing.links[l].kind != LinkKind::distant;
  return contact;
}
std::vector<bool> contacts_of(const SphereNetwork& network) {
  std::vector<bool> contact;
  for (const Link<3>& link : network.packing.links) contact.push_back(link.kind != LinkKind::distant);
  return contact;
}

template <class Network>
Json stiffness_of_network(const Network& network, const AnalysisInput& input, const AnalysisOptions& options) {
  const NetworkLaw network_law = input.network_law(options);
  const ExactRank rank = exact_rank(network, network_law, options.cell_free);
  const auto [g, k] = stiff_rows(input, options);
  const bool definite = std::all_of(k.begin(), k.end(), [](double v) { return v > 0; });

  Json section{{"positive_definite", nullptr}, {"inertia", nullptr}, {"stiffness", stiffness_of(input, options)}};
  section["explanation"] = explain_floppy(rank);
  std::array<std::int64_t, 2> inertia = {0, rank.rank};  // k > 0: Gt k G has the null space of G, and nothing below it
  try {
    const auto dependent = dependent_columns(network, network_law, options.cell_free);
    std::vector<char> keep(dependent.size());
    for (std::size_t c = 0; c < keep.size(); ++c) keep[c] = !dependent[c];
    const SymmetricMatrix inner = principal_submatrix(weighted_normal_matrix(g, k), keep);
    const SparseCholesky factor(inner, definite ? SparseCholesky::Form::definite : SparseCholesky::Form::indefinite);
    if (!definite) inertia = factor.inertia();
    section["factor"] = {
        {"columns", inner.size}, {"entries", factor.factor_entries()}, {"pivot_ratio", factor.pivot_ratio()}};
  } catch (const FactorisationFailed& e) {
    section["factor"] = {{"failed", e.what()}};
    if (!definite) return section;  // the signs are then unknown
  }
  section["inertia"] = {inertia[0], rank.dofs - inertia[0] - inertia[1], inertia[1]};
  section["positive_definite"] = inertia[0] == 0 && rank.mechanisms == 0;
  return section;
}

Json moduli_of_spheres(const AnalysisInput& input, const AnalysisOptions& options) {
  const SphereNetwork network = input.spheres();
  const NetworkLaw law = input.network_law(options);
  const ExactRank rank = exact_rank(network, law, false);
  Json section = {{"tensor", nullptr}, {"floppy", rank.mechanisms > 0}, {"explanation", explain_floppy(rank)}};
  try {
    add_response(section, elastic_response(network, law, sphere_stiffness(input, options)), contacts_of(network));
  } catch (const FactorisationFailed& e) {
    section["failed"] = e.what();
  }
  section["stiffness"] = stiffness_of(input, options);
  return section;
}

}  // namespace

Json stiffness_section(const AnalysisInput& input, const AnalysisOptions& options) {
  return input.packing_3d ? stiffness_of_network(input.spheres(), input, options)
                          : stiffness_of_network(input.network(), input, options);
}

Json moduli_section(const AnalysisInput& input, const AnalysisOptions& options) {
  if (input.packing_3d) return moduli_of_spheres(input, options);
  const LinkNetwork network = input.network();
  const NetworkLaw network_law = input.network_law(options);
  const DiskLaw law = law_of(input, options);
  const ExactRank rank = exact_rank(network, network_law, false);
  Json section = {{"tensor", nullptr}, {"floppy", rank.mechanisms > 0}, {"explanation", explain_floppy(rank)}};
  try {
    add_response(section, elastic_response(network, network_law, law), contacts_of(network));
  } catch (const FactorisationFailed& e) {
    section["failed"] = e.what();
  }
  section["stiffness"] = stiffness_of(input, options);
  // Friction between triangles has no geometric term here.
  const bool own_units = input.has_law() || !options.stiffness.empty();  // forces in those of the stiffness
  if (own_units && read_forces(input).known && !(input.triangles && network_law == NetworkLaw::friction)) {
    try {
      const TangentModuli tangent = tangent_moduli(network, network_law, law);
      section["with_geometric_term"] = described(tangent.tensor);
      section["with_geometric_term"]["antisymmetric_part"] = tangent.antisymmetric_part;
    } catch (const FactorisationFailed& e) {
      section["with_geometric_term"] = {{"tensor", nullptr}, {"failed", e.what()}};
    }
  }
  return section;
}

Json modes_section(const AnalysisInput& input, const AnalysisOptions& options) {
  Json section{{"omega", nullptr}};
  try {
    if (!options.modes || *options.modes > 0) {
      const VibrationModes modes = modes_of(input, options, mode_count(input, options), false);
      section["omega"] = modes.omega;
      section["participation"] = modes.participation;
      section["zero_modes"] = modes.zero_modes;
      section["converged"] = modes.converged;
    }
  } catch (const FactorisationFailed& e) {
    section["reason"] = e.what();
  }
  section["degrees_of_freedom"] = dof_count(input, options);
  if (options.density) {
    const DensityOfStates density = density_of_states(input, options);
    section["zero_modes"] = density.zero_modes;
    section["density"] = described(density);
  }
  section["stiffness"] = stiffness_of(input, options);
  if (!options.prestress) return section;
  try {
    const PrestressedModes modes = prestressed_modes(input.network(), input.network_law(options),
                                                     law_of(input, options), mode_count(input, options));
    Json omega_squared = Json::array();
    for (const auto& v : modes.omega_squared) omega_squared.push_back({v.real(), v.imag()});
    section["with_geometric_term"] = {
        {"omega_squared", omega_squared}, {"residual", modes.residual},
        {"pieces", modes.pieces},         {"unlinked_dofs", modes.unlinked_dofs},
        {"shift", modes.shift},           {"antisymmetric_part", modes.antisymmetric_part},
        {"converged", modes.converged}};
  } catch (const FactorisationFailed& e) {
    section["with_geometric_term"] = {{"omega_squared", nullptr}, {"failed", e.what()}};
  }
  return section;
}

std::vector<Table> modes_tables(const AnalysisInput& input, const AnalysisOptions& options) {
  if (!options.modes || *options.modes == 0) return {};  // the report has them all, or none are asked for
  const VibrationModes modes = modes_of(input, options, std::max(*options.modes, kTabulatedModes), false);
  Table density{"modes.density", {"omega", "modes_below", "participation"}, {}};
  for (std::size_t k = 0; k < modes.omega.size(); ++k)
    density.rows.push_back(
        {modes.omega[k], static_cast<double>(modes.zero_modes) + static_cast<double>(k) + 1, modes.participation[k]});
  return {density};
}

}  // namespace isostat
