#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/network/force_scale.hpp"
#include "analysis/rigidity/exact_rank.hpp"
#include "analysis/rigidity/independent_columns.hpp"
#include "analysis/rigidity/sections.hpp"
#include "analysis/stiffness/moduli.hpp"
#include "analysis/stiffness/prestressed_modes.hpp"
#include "analysis/stiffness/pseudo_inverse.hpp"
#include "analysis/stiffness/stiffness_matrix.hpp"
#include "analysis/stiffness/vibration.hpp"
#include "dem/disks/at_rest.hpp"

namespace isostat {
namespace {

using Json = nlohmann::ordered_json;
constexpr int kReportedModes = 20, kTabulatedModes = 100;

Json stiffness_of(const AnalysisInput& input) {
  if (input.triangles) {
    const TriangleLaw& t = input.triangles->law;
    return {{"modulus", t.modulus},
            {"overlap_length", t.overlap_length > 0 ? Json(t.overlap_length) : Json(nullptr)},
            {"tangential", t.tangential_stiffness}};
  }
  const DiskLaw law = law_of(input);
  return {{"normal", law.normal_stiffness},
          {"tangential", law.tangential_stiffness},
          {"rolling", law.rolling_stiffness},
          {"distant", law.attraction_range > 0 ? Json(distant(law, 0).stiffness) : Json(nullptr)}};
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

}  // namespace

Json stiffness_section(const AnalysisInput& input, const AnalysisOptions& options) {
  const LinkNetwork network = input.network();
  const NetworkLaw network_law = input.network_law(options);
  const DiskLaw law = law_of(input);
  const ExactRank rank = exact_rank(network, network_law, options.cell_free);
  const RigidityMatrix g = rigidity_matrix(network, network_law, options.cell_free);
  const std::vector<double> k = row_stiffness(network, g, law);
  const bool definite = std::all_of(k.begin(), k.end(), [](double v) { return v > 0; });

  Json section{{"positive_definite", nullptr}, {"inertia", nullptr}, {"stiffness", stiffness_of(input)}};
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

Json moduli_section(const AnalysisInput& input, const AnalysisOptions& options) {
  const LinkNetwork network = input.network();
  const NetworkLaw network_law = input.network_law(options);
  const DiskLaw law = law_of(input);
  const ExactRank rank = exact_rank(network, network_law, false);
  Json section = {{"tensor", nullptr}, {"floppy", rank.mechanisms > 0}, {"explanation", explain_floppy(rank)}};
  try {
    const Json values = described(elastic_moduli(network, network_law, law));
    for (const auto& [key, value] : values.items()) section[key] = value;
  } catch (const FactorisationFailed& e) {
    section["failed"] = e.what();
  }
  section["stiffness"] = stiffness_of(input);
  // Friction between triangles has no geometric term here.
  if (read_forces(input).known && !(input.triangles && network_law == NetworkLaw::friction)) {
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
  const LinkNetwork network = input.network();
  const NetworkLaw network_law = input.network_law(options);
  const DiskLaw law = law_of(input);
  Json section{{"omega", nullptr}};
  try {
    const VibrationModes modes = vibration_modes(network, network_law, law, kReportedModes, false);
    section["omega"] = modes.omega;
    section["zero_modes"] = modes.zero_modes;
    section["converged"] = modes.converged;
  } catch (const FactorisationFailed& e) {
    section["reason"] = e.what();
  }
  if (!options.prestress) return section;
  try {
    const PrestressedModes modes = prestressed_modes(network, network_law, law, kReportedModes);
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
  const LinkNetwork network = input.network();
  const NetworkLaw network_law = input.network_law(options);
  const VibrationModes modes = vibration_modes(network, network_law, law_of(input), kTabulatedModes, false);
  Table density{"modes.density", {"omega", "modes_below"}, {}};
  for (std::size_t k = 0; k < modes.omega.size(); ++k)
    density.rows.push_back({modes.omega[k], static_cast<double>(modes.zero_modes) + static_cast<double>(k) + 1});
  return {density};
}

}  // namespace isostat
