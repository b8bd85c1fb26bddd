#include "analysis/report.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "analysis/network/contact_tolerance.hpp"
#include "analysis/network/force_scale.hpp"
#include "analysis/network/sections.hpp"
#include "analysis/network/triangle_sections.hpp"
#include "analysis/rigidity/sections.hpp"
#include "analysis/structure/merge_curves.hpp"
#include "analysis/structure/sections.hpp"
#include "analysis/version.hpp"
#include "dem/input_error.hpp"

namespace isostat {

const std::vector<Section>& sections() {
  static const std::vector<Section> table{
      {.name = "counts",
       .takes = {.space = true, .triangles = OfTriangles::any},
       .compute = counts_section,
       .tables = counts_tables,
       .warning = contact_warning},
      {.name = "equilibrium",
       .takes = {.space = true, .triangles = OfTriangles::any, .forces = Forces::needed},
       .compute = equilibrium_section,
       .warning = balance_warning},
      {.name = "stress",
       .takes = {.space = true,
                 .triangles = OfTriangles::any,
                 .cell_for = "an isolated packing has no area and no volume",
                 .forces = Forces::needed},
       .compute = stress_section},
      {.name = "beams",
       .takes = {.triangles = OfTriangles::any, .beams = true},
       .compute = beams_section,
       .tables = beams_tables},
      {.name = "forces",
       .takes = {.space = true, .forces = Forces::needed},
       .compute = forces_section,
       .tables = forces_tables},
      {.name = "percolation",
       .takes = {.space = true, .cell_for = "a network percolates to its own image", .forces = Forces::needed},
       .compute = percolation_section},
      {.name = "stressed", .takes = {.space = true, .forces = Forces::needed}, .compute = stressed_section},
      {.name = "two_contacts",
       .takes = {.space = true, .forces = Forces::needed},
       .compute = two_contacts_section,
       .tables = two_contacts_tables},
      {.name = "rigidity",
       .takes = {.space = true, .triangles = OfTriangles::with_energy},
       .compute = rigidity_section,
       .warning = contact_warning},
      {.name = "clusters",
       .takes = {.space = true, .triangles = OfTriangles::with_energy},
       .compute = clusters_section,
       .tables = clusters_tables,
       .warning = contact_warning},
      {.name = "loops", .takes = {}, .compute = loops_section, .tables = loops_tables, .warning = contact_warning},
      {.name = "stiffness",
       .takes = {.space = true, .triangles = OfTriangles::with_energy, .stiffness = true},
       .compute = stiffness_section,
       .warning = contact_warning},
      {.name = "moduli",
       .takes = {.space = true,
                 .triangles = OfTriangles::with_energy,
                 .cell_for = "elastic moduli are those of its strains",
                 .stiffness = true,
                 .strains = true},
       .compute = moduli_section,
       .warning = contact_warning},
      {.name = "modes",
       .takes =
           {.space = true, .triangles = OfTriangles::with_energy, .forces = Forces::with_prestress, .stiffness = true},
       .compute = modes_section,
       .tables = modes_tables,
       .only_when_named = true,
       .warning = contact_warning},
      {.name = "bases",
       .takes = {.space = true, .triangles = OfTriangles::with_energy},
       .compute = bases_section,
       .tables = bases_tables,
       .only_when_named = true,
       .warning = contact_warning},
      {.name = "pores", .takes = {}, .compute = pores_section},
      {.name = "scattering",
       .takes = {.cell_for = "I(k) lives on its reciprocal lattice", .grains = true},
       .compute = scattering_section,
       .align = align_scattering,
       .pooled = pooled_scattering},
      {.name = "dacf",
       .takes = {.cell_for = "C(r) averages over it", .grains = true},
       .compute = dacf_section,
       .align = align_dacf,
       .pooled = pooled_dacf,
       .only_when_named = true},
      {.name = "rdf",
       .takes = {.plane = false, .space = true, .cell_for = "g(r) compares with its density", .grains = true},
       .compute = rdf_section},
  };
  return table;
}

std::vector<std::string> parse_section_names(const std::string& comma_separated) {
  std::vector<std::string> names;
  std::vector<Fault> faults;
  std::string all;
  for (const Section& s : sections()) all += (all.empty() ? "" : ", ") + std::string(s.name);
  std::istringstream in(comma_separated);
  for (std::string name; std::getline(in, name, ',');) {
    const bool known =
        std::any_of(sections().begin(), sections().end(), [&](const Section& s) { return s.name == name; });
    if (!known) faults.push_back({"command line", 0, "--only", name, "names sections among: " + all});
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  if (!faults.empty()) throw InputError(std::move(faults));
  return names;
}

namespace {

// An undefined number is null, in memory as in the file.
void set_undefined_to_null(nlohmann::ordered_json& value) {
  if (value.is_number_float() && !std::isfinite(value.get<double>())) value = nullptr;
  if (value.is_structured())
    for (auto& member : value) set_undefined_to_null(member);
}

// Lengths, masses and forces of the report are in these units; `si` appears when the scene maps the run to SI.
nlohmann::ordered_json units_of(const AnalysisInput& input) {
  if (input.triangles)
    return {{"system", "cgs"}, {"length", "cm"},       {"mass", "g"},
            {"force", "dyn"},  {"pressure", "dyn/cm"}, {"time", "s"}};
  if (!input.has_law()) return {{"system", "of the input file"}};
  if (input.packing_3d)
    return {{"system", "reduced"}, {"length", "a"},        {"mass", "m"},
            {"force", "F0"},       {"pressure", "F0/a^2"}, {"time", "T0"}};
  const bool cohesive = input.state.law.attraction > 0, pressed = input.has_cell() || !(input.state.scene.gravity > 0);
  nlohmann::ordered_json units{{"system", "reduced"},
                               {"length", "a"},
                               {"mass", "m"},
                               {"force", cohesive  ? "F0"
                                         : pressed ? "a P"
                                                   : "m a / T0^2"},
                               {"pressure", cohesive  ? "F0/a"
                                            : pressed ? "P"
                                                      : "m / T0^2"},
                               {"time", cohesive  ? "sqrt(m a / F0)"
                                        : pressed ? "sqrt(m / P)"
                                                  : "T0"}};
  if (const auto& si = input.state.scene.units)
    units["si"] = {{"length_m", si->length}, {"density_kg_per_m2", si->density}, {"force_N", si->force}};
  return units;
}

// Why a section does not take grains of triangles; none: it does.
std::optional<std::string> refusal_of_triangles(const Takes& takes, const AnalysisInput& input,
                                                const AnalysisOptions& options) {
  const TriangleLaw& law = input.triangles->law;
  if (takes.triangles == OfTriangles::none) return "is defined for disks; this packing is of grains of triangles";
  if (takes.triangles == OfTriangles::any) return std::nullopt;
  if (law.contact == ContactLaw::paper)
    return "needs overlaps that have an energy: the law `paper` has none, use `overlap-energy`";
  const NetworkLaw rows = input.network_law(options);
  if (rows == NetworkLaw::rolling) return "overlaps have no rolling row; use --law frictionless or --law friction";
  if (takes.stiffness && rows == NetworkLaw::friction && !(law.tangential_stiffness > 0))
    return "the law of the state has no tangential stiffness; use --law frictionless";
  if (takes.forces == Forces::with_prestress && options.prestress && rows == NetworkLaw::friction)
    return "--prestress knows no geometric term of friction between triangles; use --law frictionless";
  if ((takes.strains || options.cell_free) && input.network().any_held())
    return "strains the cell, and this one has walls in it that hold";
  return std::nullopt;
}

bool has_tangential_stiffness(const AnalysisInput& input) {
  if (!input.spheres_state) return input.state.law.tangential_stiffness > 0;
  const SphereLaw& law = input.spheres_state->law;
  return law.normal == NormalForce::hertz || law.tangential_stiffness > 0;
}

// Why a section does not take the input; none: it does.
std::optional<std::string> refusal(const Takes& takes, const AnalysisInput& input, const AnalysisOptions& options) {
  if (!input.packing_3d && !takes.plane) return "is defined for spheres; this packing is in the plane";
  if (input.packing_3d && !takes.space) return "is defined for packings in the plane; this one is in 3D";
  if (!input.has_cell() && !takes.cell_for.empty()) return "needs a periodic cell: " + std::string(takes.cell_for);
  if (input.grains() == 0 && takes.grains) return "needs at least one grain";
  if (takes.beams && !input.triangles) return "needs grains of triangles joined by beams";
  const bool forces = read_forces(input).known;
  if (!forces && takes.forces == Forces::needed) return "needs forces: this input has none";
  if (!forces && takes.forces == Forces::with_prestress && options.prestress)
    return "--prestress needs the forces of the links";
  if (input.packing_3d && takes.forces == Forces::with_prestress && options.prestress)
    return "--prestress is for packings in the plane";
  if (!input.has_law() && takes.forces == Forces::with_prestress && options.prestress && options.stiffness.empty())
    return "--prestress needs the stiffness of the contacts in the units of their forces: --stiffness";
  if (input.packing_3d && (takes.strains || (takes.stiffness && options.cell_free)) && input.spheres().any_held())
    return "strains the cell, and this one has walls in it that hold";
  if (input.triangles && takes.stiffness && !options.stiffness.empty()) return "--stiffness is for disks and spheres";
  if (input.triangles) return refusal_of_triangles(takes, input, options);
  if (takes.stiffness && input.has_law() && !options.stiffness.empty())
    return "--stiffness is for packings without a law, and this one has its own";
  if (takes.stiffness && input.has_law()) {  // a state's law fills only the axes it has; a network's law has all
    const NetworkLaw rows = input.network_law(options);
    if (rows != NetworkLaw::frictionless && !has_tangential_stiffness(input))
      return "the law of the state has no tangential stiffness; use --law frictionless";
    const double rolling =
        input.spheres_state ? input.spheres_state->law.rolling_stiffness : input.state.law.rolling_stiffness;
    if (rows == NetworkLaw::rolling && !(rolling > 0))
      return "the law of the state has no rolling stiffness; use --law friction";
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> refusal_of(std::string_view section, const AnalysisInput& input,
                                      const AnalysisOptions& options) {
  const auto found =
      std::find_if(sections().begin(), sections().end(), [&](const Section& s) { return s.name == section; });
  return refusal(found->takes, input, options);
}

nlohmann::ordered_json analyze(const AnalysisInput& input, const AnalysisOptions& options,
                               const std::vector<std::string>& only) {
  nlohmann::ordered_json report;
  report["isostat"] = version();
  report["inputs"] = {input.path};
  report["units"] = units_of(input);
  std::vector<std::string (*)(const AnalysisInput&)> warnings;  // one of several sections is told once
  for (const Section& section : sections()) {
    const bool named = std::find(only.begin(), only.end(), section.name) != only.end();
    if (!named && (!only.empty() || section.only_when_named)) continue;
    if (const auto why = refusal(section.takes, input, options)) {
      if (named) throw InputError(input.path, 0, "--only", std::string(section.name), *why);
      continue;
    }
    try {
      if (options.begins) options.begins(section.name);
      auto value = section.compute(input, options);
      report[section.name] = std::move(value);
      if (section.warning && std::find(warnings.begin(), warnings.end(), section.warning) == warnings.end())
        warnings.push_back(section.warning);
    } catch (const InputError&) {
      if (named) throw;  // else it is absent like one that does not take the input
    }
  }
  for (const auto warning : warnings)
    if (const std::string text = warning(input); !text.empty()) report["warnings"].push_back(input.path + ": " + text);
  set_undefined_to_null(report);
  return report;
}

}  // namespace isostat
