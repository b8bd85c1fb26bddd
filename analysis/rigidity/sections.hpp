// Sections of `analyze` about rigidity and stiffness (docs/rigidity.md has every key).
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "analysis/section.hpp"

namespace isostat {

nlohmann::ordered_json rigidity_section(const AnalysisInput& input, const AnalysisOptions& options);
nlohmann::ordered_json clusters_section(const AnalysisInput& input, const AnalysisOptions& options);
nlohmann::ordered_json stiffness_section(const AnalysisInput& input, const AnalysisOptions& options);
nlohmann::ordered_json moduli_section(const AnalysisInput& input, const AnalysisOptions& options);
nlohmann::ordered_json modes_section(const AnalysisInput& input, const AnalysisOptions& options);
nlohmann::ordered_json bases_section(const AnalysisInput& input, const AnalysisOptions& options);

std::vector<Table> clusters_tables(const AnalysisInput& input, const AnalysisOptions& options);
std::vector<Table> modes_tables(const AnalysisInput& input, const AnalysisOptions& options);
nlohmann::ordered_json loops_section(const AnalysisInput& input, const AnalysisOptions& options);
std::vector<Table> loops_tables(const AnalysisInput& input, const AnalysisOptions& options);
std::vector<Table> bases_tables(const AnalysisInput& input, const AnalysisOptions& options);

}  // namespace isostat
