// What `isostat analyze` computes: a table of named sections, each computed only when asked for.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "analysis/section.hpp"

namespace isostat {

const std::vector<Section>& sections();  // in the order of the report

// Names of `--only`, checked; empty text: none. Throws InputError naming the unknown ones.
std::vector<std::string> parse_section_names(const std::string& comma_separated);

// Why a section does not take an input; none: it does.
std::optional<std::string> refusal_of(std::string_view section, const AnalysisInput& input,
                                      const AnalysisOptions& options);

// The report of one input. With no name every section that takes it is computed but those that must be named; a named
// one that does not take it throws InputError.
nlohmann::ordered_json analyze(const AnalysisInput& input, const AnalysisOptions& options,
                               const std::vector<std::string>& only);

}  // namespace isostat
