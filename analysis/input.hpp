// What `isostat analyze` works on: a packing, the law it may bring, and the options of the command line.
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "dem/state/packing.hpp"
#include "dem/state/state.hpp"

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

// InputError of a section that does not apply to the input.
[[noreturn]] void refuse_section(const AnalysisInput& input, std::string_view section, std::string why);

}  // namespace isostat
