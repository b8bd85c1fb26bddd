// Sections of `analyze` about the force-carrying network (docs/report.md has every key).
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "analysis/section.hpp"

namespace isostat {

nlohmann::ordered_json counts_section(const AnalysisInput& input, const AnalysisOptions& options);
nlohmann::ordered_json equilibrium_section(const AnalysisInput& input, const AnalysisOptions& options);
nlohmann::ordered_json stress_section(const AnalysisInput& input, const AnalysisOptions& options);
nlohmann::ordered_json forces_section(const AnalysisInput& input, const AnalysisOptions& options);
nlohmann::ordered_json percolation_section(const AnalysisInput& input, const AnalysisOptions& options);
nlohmann::ordered_json stressed_section(const AnalysisInput& input, const AnalysisOptions& options);
nlohmann::ordered_json two_contacts_section(const AnalysisInput& input, const AnalysisOptions& options);

// Of a packing without law whose forces do not balance, which of them and how far; else empty.
std::string balance_warning(const AnalysisInput& input);

std::vector<Table> counts_tables(const AnalysisInput& input, const AnalysisOptions& options);
std::vector<Table> forces_tables(const AnalysisInput& input, const AnalysisOptions& options);
std::vector<Table> two_contacts_tables(const AnalysisInput& input, const AnalysisOptions& options);

}  // namespace isostat
