// Section "counts": coordination numbers and solid fractions.
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "analysis/network/contact_tolerance.hpp"
#include "analysis/network/coordination.hpp"
#include "analysis/network/sections.hpp"
#include "analysis/network/triangle_sections.hpp"
#include "dem/state/solid_fraction.hpp"

namespace isostat {
namespace {

constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();  // written as null

// Gilabert 2007, Eq. 14 (Campbell): the 3D solid fraction that corresponds to one of disks.
double corresponding_solid_fraction_3d(double phi) {
  return 4.0 / (3.0 * std::sqrt(std::numbers::pi)) * std::pow(phi, 1.5);
}

// Proportions of the non-rattlers with k = 0, 1, ... interactions; at least up to k = 6, as in Figs. 3 and 6.
template <int D>
std::vector<double> proportions(const Packing<D>& packing, const Coordination& c) {
  std::vector<double> x(7, 0.0);
  const auto rest = static_cast<double>(static_cast<std::int64_t>(count_free(packing)) - c.rattlers);
  for (std::size_t k = 0; k < c.degree.size(); ++k) {
    if (c.rattler[k] || !is_free(packing.part, k)) continue;
    const auto z = static_cast<std::size_t>(c.backbone_degree[k]);
    if (z >= x.size()) x.resize(z + 1, 0.0);
    x[z] += 1;
  }
  for (double& v : x) v = rest > 0 ? v / rest : kUndefined;
  return x;
}

template <int D>
nlohmann::ordered_json counts_of(const Packing<D>& packing, const ForceReading& reading) {
  const Coordination c = coordination(packing, reading);
  nlohmann::ordered_json json;
  json["grains"] = count_free(packing);
  json["contacts"] = c.contacts;
  if (!packing.part.empty()) json["contacts_with_walls"] = c.with_walls;
  json["distant"] = c.distant;
  json["unloaded_contacts"] = c.unloaded;
  if (c.beams > 0) json["beams"] = c.beams;
  json["rattlers"] = c.rattlers;
  std::int64_t floating = 0;  // whatever the law: rattlers are defined by it
  for (std::size_t k = 0; k < c.degree.size(); ++k)
    floating += c.degree[k] == 0 && !c.held[k] && is_free(packing.part, k);
  json["floating"] = floating;
  const double phi = solid_fraction(packing.bodies, packing.cell);
  json["solid_fraction"] = phi;
  json["solid_fraction_3d"] = D == 2 ? corresponding_solid_fraction_3d(phi) : phi;
  json["z"] = mean_degree(packing, c);
  json["z_star"] = mean_backbone_degree(packing, c);
  json["x"] = proportions(packing, c);
  auto one_coordinated = nlohmann::ordered_json::array();
  for (std::size_t k = 0; k < c.degree.size(); ++k)
    if (!c.rattler[k] && !c.held[k] && c.backbone_degree[k] == 1) one_coordinated.push_back(packing.bodies.id[k]);
  json["one_coordinated"] = std::move(one_coordinated);
  return json;
}

template <int D>
Table grains_of(const Packing<D>& packing, const ForceReading& reading) {
  const Coordination c = coordination(packing, reading);
  Table table{"grains", {"id", "x", "y", "r", "interactions", "backbone_interactions", "rattler"}, {}};
  if constexpr (D == 3) table.columns.insert(table.columns.begin() + 3, "z");
  for (std::size_t k = 0; k < packing.bodies.size(); ++k) {
    if (!is_free(packing.part, k)) continue;
    std::vector<double> row{static_cast<double>(packing.bodies.id[k])};
    for (int d = 0; d < D; ++d) row.push_back(packing.bodies.position[k][d]);
    row.insert(row.end(), {packing.bodies.radius[k], static_cast<double>(c.degree[k]),
                           static_cast<double>(c.backbone_degree[k]), static_cast<double>(c.rattler[k])});
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace

nlohmann::ordered_json counts_section(const AnalysisInput& input, const AnalysisOptions&) {
  if (input.triangles) return triangle_counts(input);
  const ForceReading reading = read_forces(input);
  auto json = input.packing_3d ? counts_of(*input.packing_3d, reading) : counts_of(input.packing(), reading);
  if (!input.touching_tolerance || input.grains() == 0) return json;
  const ContactTolerance found = contact_tolerance(input);
  json["z_of_tolerance"] = {
      {"used", found.used}, {"tolerance", found.tolerance}, {"contacts", found.contacts}, {"z", found.z}};
  return json;
}

std::vector<Table> counts_tables(const AnalysisInput& input, const AnalysisOptions&) {
  if (input.triangles) return triangle_counts_tables(input);
  const ForceReading reading = read_forces(input);
  return {input.packing_3d ? grains_of(*input.packing_3d, reading) : grains_of(input.packing(), reading)};
}

}  // namespace isostat
