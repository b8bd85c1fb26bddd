// Sections of the report for grains of triangles, where they differ from those for disks (docs/report.md).
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "analysis/section.hpp"

namespace isostat {

nlohmann::ordered_json triangle_counts(const AnalysisInput& input);
std::vector<Table> triangle_counts_tables(const AnalysisInput& input);
nlohmann::ordered_json triangle_stress(const State<TriangleGrains>& state);

// Of the beams inside grains; with its tables.
nlohmann::ordered_json beams_section(const AnalysisInput& input, const AnalysisOptions& options);
std::vector<Table> beams_tables(const AnalysisInput& input, const AnalysisOptions& options);

}  // namespace isostat
