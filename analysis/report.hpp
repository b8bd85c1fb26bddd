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
  std::optional<NetworkLaw> law;        // --law; none: the state's own law (a network: friction)
  bool cell_free = false;               // --cell free: add the diagonal strain dofs
  std::optional<double> gap_tolerance;  // --gap-tolerance [length of the input]
  bool prestress = false;               // --prestress: modes of the full tangent, too
  bool near_null = false;               // --near-null: near-null singular values of G whatever its size
  int most_vectors = 20;                // --vectors: of each basis of the section bases
  double k_max = 0;                     // --k-max [1/length]; 0: the section's default
};

struct AnalysisInput {
  std::string path;
  Packing<2> packing;
  std::optional<Packing<3>> packing_3d;  // a 3D network or foreign packing; `packing` is then empty
  std::optional<State> state;            // absent for a plain-text network or foreign packing
  bool links_given = false;              // the file lists links (a state always does); false: grains alone
  NetworkLaw network_law(const AnalysisOptions& options) const;
  // The planar packing; throws InputError naming the section if the input is 3D.
  const Packing<2>& planar(std::string_view section) const;
};

// A table of numbers that goes with a section into `--csv DIR` as DIR/NAME.csv.
struct Table {
  std::string name;
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;
};

// A section: name, and a function from input to its JSON value. Throws InputError if it does not apply.
struct Section {
  std::string_view name;
  nlohmann::ordered_json (*compute)(const AnalysisInput&, const AnalysisOptions&);
  // Rows too many for the report, computed only for --csv. What the JSON value holds becomes tables by itself.
  std::vector<Table> (*tables)(const AnalysisInput&, const AnalysisOptions&) = nullptr;
  // Ensembles of binned curves: brings the values of several inputs onto common bins before they are merged entry by
  // entry; false: they have none, and the merged report keeps one value an input.
  bool (*align)(std::vector<nlohmann::ordered_json>&) = nullptr;
  // What is computed from all inputs together and not by averaging; stands as "pooled" in the merged section.
  nlohmann::ordered_json (*pooled)(const std::vector<nlohmann::ordered_json>&) = nullptr;
  // Long to compute or to read: left out unless it is named.
  bool only_when_named = false;
};
const std::vector<Section>& sections();  // in the order of the report

// Names of `--only`, checked; empty text: none. Throws InputError naming the unknown ones.
std::vector<std::string> parse_section_names(const std::string& comma_separated);

// The report of one input. With no name every section that applies is computed but those that
// must be named; a named one that does not apply throws.
nlohmann::ordered_json analyze(const AnalysisInput& input, const AnalysisOptions& options,
                               const std::vector<std::string>& only);

// InputError of a section that does not apply to the input.
[[noreturn]] void refuse_section(const AnalysisInput& input, std::string_view section, std::string why);

}  // namespace isostat
