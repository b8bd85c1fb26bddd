#include "analysis/report.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "analysis/network/sections.hpp"
#include "analysis/rigidity/sections.hpp"
#include "analysis/structure/sections.hpp"
#include "analysis/version.hpp"
#include "dem/input_error.hpp"

namespace isostat {

const std::vector<Section>& sections() {
  static const std::vector<Section> table{
      {"counts", counts_section, counts_tables},
      {"equilibrium", equilibrium_section},
      {"stress", stress_section},
      {"forces", forces_section, forces_tables},
      {"percolation", percolation_section},
      {"rigidity", rigidity_section},
      {"clusters", clusters_section, clusters_tables},
      {"stiffness", stiffness_section},
      {"moduli", moduli_section},
      {.name = "modes", .compute = modes_section, .tables = modes_tables, .only_when_named = true},
      {.name = "bases", .compute = bases_section, .tables = bases_tables, .only_when_named = true},
      {"pores", pores_section},
      {"scattering", scattering_section},
      {"dacf", dacf_section},
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
  if (!input.state || !(input.state->law.normal_stiffness > 0)) return {{"system", "of the input file"}};
  const bool cohesive = input.state->law.attraction > 0;
  nlohmann::ordered_json units{{"system", "reduced"},
                               {"length", "a"},
                               {"mass", "m"},
                               {"force", cohesive ? "F0" : "a P"},
                               {"time", cohesive ? "sqrt(m a / F0)" : "sqrt(m / P)"}};
  if (const auto& si = input.state->scene.units)
    units["si"] = {{"length_m", si->length}, {"density_kg_per_m2", si->density}, {"force_N", si->force}};
  return units;
}

}  // namespace

nlohmann::ordered_json analyze(const AnalysisInput& input, const AnalysisOptions& options,
                               const std::vector<std::string>& only) {
  nlohmann::ordered_json report;
  report["isostat"] = version();
  report["inputs"] = {input.path};
  report["units"] = units_of(input);
  for (const Section& section : sections()) {
    if (only.empty()) {
      if (section.only_when_named) continue;
      try {
        report[section.name] = section.compute(input, options);
      } catch (const InputError&) {
        report.erase(std::string(section.name));  // does not apply, and nobody asked for it by name
      }
    } else if (std::find(only.begin(), only.end(), section.name) != only.end()) {
      report[section.name] = section.compute(input, options);
    }
  }
  set_undefined_to_null(report);
  return report;
}

}  // namespace isostat
