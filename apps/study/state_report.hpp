// The report of one state, kept in a file beside it and computed only where that does not hold it already.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "apps/study/study.hpp"

namespace isostat {

// The report at `path` if it is of this very state (physical hash and resolved scene), by this version of the program,
// with these options; it may lack sections, or hold more than are asked for. None otherwise.
std::optional<nlohmann::ordered_json> stored_report(const std::string& path, const std::string& state_path,
                                                    const AnalysisOptions& options);

// Whether a stored report has all sections.
bool has_sections(const nlohmann::ordered_json& report, const std::vector<std::string>& sections);

// Computes the sections that the stored report lacks and stores them with the others. Throws InputError for a section
// that does not apply.
void update_report(const std::string& path, const std::string& state_path, const StudyAnalysis& analysis);

}  // namespace isostat
