#include "analysis/stiffness/sphere_bases.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/network/force_scale.hpp"
#include "analysis/rigidity/exact_rank.hpp"
#include "analysis/rigidity/rigidity_matrix.hpp"
#include "analysis/stiffness/bases.hpp"
#include "analysis/stiffness/sparse_cholesky.hpp"
#include "analysis/vector_algebra.hpp"
#include "geometry/base/index.hpp"

namespace isostat {
namespace {

using Json = nlohmann::ordered_json;
using Vector = std::vector<double>;

constexpr double kTouched = 1e-9;  // of the largest component: smaller ones count as rounding in "grains", "links"

struct Question {
  SphereNetwork network;
  NetworkLaw law;
  bool cell_free;
  std::size_t most;
  RigidityMatrix g;
  Question(const AnalysisInput& input, const AnalysisOptions& options)
      : network(input.spheres()),
        law(input.network_law(options)),
        cell_free(options.cell_free),
        most(idx(options.most_vectors)),
        g(rigidity_matrix(network, law, cell_free)) {}
};

// v and w of a grain; w is 0 where there are no spins.
std::array<double, 6> motion_of(const Question& q, const Vector& u, std::size_t grain) {
  std::array<double, 6> m{};
  const auto per_body = idx(q.g.layout.per_body);
  std::copy_n(u.begin() + static_cast<std::ptrdiff_t>(per_body * grain), per_body, m.begin());
  return m;
}

double largest_force(const SphereForces& f, std::size_t link) {
  double most = std::abs(f.normal[link]);
  for (int k = 0; k < 3; ++k) most = std::max({most, std::abs(f.tangential[link][k]), std::abs(f.moment[link][k])});
  return most;
}

Vector link_columns(const Question& q, std::size_t l) {
  const Link<3>& link = q.network.packing.links[l];
  const auto& id = q.network.packing.bodies.id;
  Vector line{static_cast<double>(id[idx(link.i)]), static_cast<double>(id[idx(link.j)])};
  line.insert(line.end(), link.shift.begin(), link.shift.end());
  return line;
}
void add_forces(Vector& line, const SphereForces& f, std::size_t l) {
  line.push_back(f.normal[l]);
  for (const auto* v : {&f.tangential[l], &f.moment[l]}) line.insert(line.end(), v->c.begin(), v->c.end());
}

Json floppy_json(const Question& q, std::int64_t of) {
  Json list = Json::array();
  for (const NullVector& v : floppy_modes(q.network, q.law, q.cell_free, q.most)) {
    std::int64_t grains = 0;
    for (std::size_t i = 0; i < idx(q.network.free); ++i) {
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
    const SphereForces forces = by_link(q.network, q.g, v.value);
    std::int64_t links = 0;
    for (std::size_t l = 0; l < q.network.links(); ++l) links += largest_force(forces, l) > kTouched;
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

Json sphere_bases(const AnalysisInput& input, const AnalysisOptions& options) {
  const Question q(input, options);
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

std::vector<Table> sphere_bases_tables(const AnalysisInput& input, const AnalysisOptions& options) {
  const Question q(input, options);
  Table modes{"floppy_modes", {"mode", "id", "vx", "vy", "vz", "wx", "wy", "wz"}, {}};
  Table strains{"floppy_strains", {"mode", "e11", "e22", "e33"}, {}};
  Table states{"self_stress", {"state", "i", "j", "s1", "s2", "s3", "N", "Tx", "Ty", "Tz", "Mx", "My", "Mz"}, {}};
  Table split{"split", {"i", "j", "s1", "s2", "s3"}, {}};
  for (const char* part : {"balancing", "self_stress"})
    for (const char* component : {"N", "Tx", "Ty", "Tz", "Mx", "My", "Mz"})
      split.columns.push_back(std::string(component) + "_" + part);
  try {
    double number = 0;
    for (const NullVector& v : floppy_modes(q.network, q.law, q.cell_free, q.most)) {
      ++number;
      for (std::size_t i = 0; i < idx(q.network.free); ++i) {
        const auto m = motion_of(q, v.value, i);
        if (m == std::array<double, 6>{}) continue;
        Vector line{number, static_cast<double>(q.network.packing.bodies.id[i])};
        line.insert(line.end(), m.begin(), m.end());
        modes.rows.push_back(std::move(line));
      }
      if (q.g.layout.strains == 0) continue;
      Vector line{number};
      line.insert(line.end(), v.value.end() - 3, v.value.end());
      strains.rows.push_back(std::move(line));
    }
    number = 0;
    for (const NullVector& v : self_stress_states(q.network, q.law, q.cell_free, q.most)) {
      ++number;
      const SphereForces forces = by_link(q.network, q.g, v.value);
      for (std::size_t l = 0; l < q.network.links(); ++l) {
        if (!(largest_force(forces, l) > 0)) continue;
        Vector line = link_columns(q, l);
        line.insert(line.begin(), number);
        add_forces(line, forces, l);
        states.rows.push_back(std::move(line));
      }
    }
    if (read_forces(input).known) {
      const ForceSplit parts = split_forces(q.network, q.law, q.cell_free, link_forces(q.network, q.g));
      const SphereForces balancing = by_link(q.network, q.g, parts.balancing),
                         self_stress = by_link(q.network, q.g, parts.self_stress);
      for (std::size_t l = 0; l < q.network.links(); ++l) {
        Vector line = link_columns(q, l);
        add_forces(line, balancing, l), add_forces(line, self_stress, l);
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
