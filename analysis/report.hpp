// What `isostat analyze` computes: a table of named sections, each computed only when asked for.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dem/packing.hpp"
#include "dem/state.hpp"

namespace isostat {

enum class NetworkLaw { frictionless, friction, rolling };  // which rows a link contributes to G

struct AnalysisOptions {
  std::optional<NetworkLaw> law;         // --law; none: the state's own law (a network: friction)
  bool cell_free = false;                // --cell free: add the diagonal strain dofs
  std::optional<double> gap_tolerance;   // --gap-tolerance [length of the input]
  double k_max = 0;                      // --k-max [1/length]; 0: the section's default
};

struct AnalysisInput {
  std::string path;
  Packing<2> packing;
  std::optional<State> state;  // absent for a plain-text network or foreign packing
  bool links_given = false;    // the file lists links (a state always does); false: grains alone
  NetworkLaw network_law(const AnalysisOptions& options) const;
};

// A section: name, and a function from input to its JSON value. Throws InputError if it does not apply.
struct Section {
  std::string_view name;
  nlohmann::ordered_json (*compute)(const AnalysisInput&, const AnalysisOptions&);
};
const std::vector<Section>& sections();  // in the order of the report

}  // namespace isostat
