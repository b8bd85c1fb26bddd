// Section `bases` of the report: floppy modes, self-stress states and the split of the forces. What the vectors hold
// goes into tables.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/network/force_scale.hpp"
#include "analysis/rigidity/exact_rank.hpp"
#include "analysis/rigidity/rigidity_matrix.hpp"
#include "analysis/rigidity/sections.hpp"
#include "analysis/stiffness/bases.hpp"
#include "analysis/stiffness/sparse_cholesky.hpp"
#include "analysis/stiffness/sphere_bases.hpp"
#include "analysis/vector_algebra.hpp"

namespace isostat {
namespace {

using Json = nlohmann::ordered_json;
using Vector = std::vector<double>;
using LinkForces = ByRow<Vector>;  // by link; 0 for a row that the link has not

constexpr double kTouched = 1e-9;  // of the largest component: smaller ones count as rounding in "grains", "links"

struct Question {
  LinkNetwork network;
  const Packing<2>& packing;  // of it
  NetworkLaw law;
  bool cell_free;
  std::size_t most;
  RigidityMatrix g;
};

Question question(const AnalysisInput& input, const AnalysisOptions& options) {
  const LinkNetwork network = input.network();
  const NetworkLaw law = input.network_law(options);
  return {network,
          network.packing,
          law,
          options.cell_free,
          static_cast<std::size_t>(options.most_vectors),
          rigidity_matrix(network, law, options.cell_free)};
}

LinkForces by_link(const Question& q, const Vector& of_row) {
  LinkForces forces;
  for (const RowKind kind : kRowKinds) forces[kind].assign(q.network.links(), 0.0);
  for (std::size_t r = 0; r < of_row.size(); ++r)
    forces[q.g.kind[r]][static_cast<std::size_t>(q.g.link_of_row[r])] = of_row[r];
  return forces;
}

bool zero_link(const LinkForces& forces, std::size_t link, double below) {
  return std::all_of(kRowKinds.begin(), kRowKinds.end(),
                     [&](RowKind kind) { return std::abs(forces[kind][link]) <= below; });
}

// An overlap stands under its first pair of triangles.
Vector link_columns(const LinkNetwork& network, std::size_t link) {
  Vector columns;
  network.each_bond(link, [&](std::int32_t i, std::int32_t j, const ImageShift<2>& shift) {
    if (!columns.empty()) return;
    const auto& id = network.packing.bodies.id;
    columns = {static_cast<double>(id[static_cast<std::size_t>(i)]),
               static_cast<double>(id[static_cast<std::size_t>(j)]), static_cast<double>(shift[0]),
               static_cast<double>(shift[1])};
  });
  return columns;
}

std::array<double, 3> motion_of(const Question& q, const Vector& u, std::size_t grain) {
  const auto per_body = static_cast<std::size_t>(q.g.layout.per_body);
  return {u[per_body * grain], u[per_body * grain + 1], per_body == 3 ? u[per_body * grain + 2] : 0.0};
}

Json floppy_json(const Question& q, std::int64_t of) {
  Json list = Json::array();
  for (const NullVector& v : floppy_modes(q.network, q.law, q.cell_free, q.most)) {
    std::int64_t grains = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(q.network.free); ++i) {
      const auto m = motion_of(q, v.value, i);
      grains += std::any_of(m.begin(), m.end(), [](double x) { return std::abs(x) > kTouched; });
    }
    list.push_back({{"grains", grains}, {"residual", v.residual}});
  }
  return {{"given", list.size()}, {"of", of}, {"list", list}};
}

Json self_stress_json(const Question& q, std::int64_t of) {
  Json list = Json::array();
  for (const NullVector& v : self_stress_states(q.network, q.law, q.cell_free, q.most)) {
    const LinkForces forces = by_link(q, v.value);
    std::int64_t links = 0;
    for (std::size_t l = 0; l < q.network.links(); ++l) links += !zero_link(forces, l, kTouched);
    list.push_back({{"links", links}, {"residual", v.residual}});
  }
  return {{"given", list.size()}, {"of", of}, {"list", list}};
}

Json split_json(const Question& q, const AnalysisInput& input) {
  if (!read_forces(input).known) return nullptr;
  const Vector forces = link_forces(q.network, q.g);
  const ForceSplit split = split_forces(q.network, q.law, q.cell_free, forces);
  const auto length = [](const Vector& v) { return std::sqrt(dot(v, v)); };
  return {{"forces", length(forces)},
          {"balancing", length(split.balancing)},
          {"self_stress", length(split.self_stress)},
          {"load", largest(q.g.body_forces(forces))},
          {"residual", split.residual}};
}

}  // namespace

Json bases_section(const AnalysisInput& input, const AnalysisOptions& options) {
  if (input.packing_3d) return sphere_bases(input, options);
  const Question q = question(input, options);
  const ExactRank rank = exact_rank(q.network, q.law, q.cell_free);
  Json section{{"law", name_of(q.law)}, {"cell", q.cell_free ? "free" : "fixed"}};
  try {
    section["floppy_modes"] = floppy_json(q, rank.floppy);
    section["self_stress"] = self_stress_json(q, rank.hyperstatic);
    section["split"] = split_json(q, input);
  } catch (const FactorisationFailed& e) {
    section["failed"] =
        std::string("the independent columns are too nearly dependent for double precision: ") + e.what();
  }
  return section;
}

std::vector<Table> bases_tables(const AnalysisInput& input, const AnalysisOptions& options) {
  if (input.packing_3d) return sphere_bases_tables(input, options);
  const Question q = question(input, options);
  Table modes{"floppy_modes", {"mode", "id", "vx", "vy", "omega"}, {}};
  Table strains{"floppy_strains", {"mode", "e11", "e22"}, {}};
  Table states{"self_stress", {"state", "i", "j", "s1", "s2", "N", "T", "M"}, {}};
  Table split{"split",
              {"i", "j", "s1", "s2", "N_balancing", "T_balancing", "M_balancing", "N_self_stress", "T_self_stress",
               "M_self_stress"},
              {}};
  try {
    double number = 0;
    for (const NullVector& v : floppy_modes(q.network, q.law, q.cell_free, q.most)) {
      ++number;
      for (std::size_t i = 0; i < static_cast<std::size_t>(q.network.free); ++i) {
        const auto m = motion_of(q, v.value, i);
        if (m == std::array<double, 3>{}) continue;
        modes.rows.push_back({number, static_cast<double>(q.packing.bodies.id[i]), m[0], m[1], m[2]});
      }
      if (q.g.layout.strains > 0)
        strains.rows.push_back({number, v.value[static_cast<std::size_t>(q.g.layout.strain_column(0))],
                                v.value[static_cast<std::size_t>(q.g.layout.strain_column(1))]});
    }
    number = 0;
    for (const NullVector& v : self_stress_states(q.network, q.law, q.cell_free, q.most)) {
      ++number;
      const LinkForces forces = by_link(q, v.value);
      for (std::size_t l = 0; l < q.network.links(); ++l) {
        if (zero_link(forces, l, 0)) continue;
        Vector line = link_columns(q.network, l);
        line.insert(line.begin(), number);
        for (const RowKind kind : kRowKinds) line.push_back(forces[kind][l]);
        states.rows.push_back(std::move(line));
      }
    }
    if (read_forces(input).known) {
      const ForceSplit parts = split_forces(q.network, q.law, q.cell_free, link_forces(q.network, q.g));
      const LinkForces balancing = by_link(q, parts.balancing), self_stress = by_link(q, parts.self_stress);
      for (std::size_t l = 0; l < q.network.links(); ++l) {
        Vector line = link_columns(q.network, l);
        for (const LinkForces* forces : {&balancing, &self_stress})
          for (const RowKind kind : kRowKinds) line.push_back((*forces)[kind][l]);
        split.rows.push_back(std::move(line));
      }
    }
  } catch (const FactorisationFailed&) {
    return {};  // the section says why
  }
  std::vector<Table> tables = {modes, states};
  if (q.g.layout.strains > 0) tables.push_back(strains);
  if (!split.rows.empty()) tables.push_back(split);
  return tables;
}

}  // namespace isostat
