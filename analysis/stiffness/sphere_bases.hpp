// Section `bases` of packings of spheres.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "analysis/section.hpp"

namespace isostat {

nlohmann::ordered_json sphere_bases(const AnalysisInput& input, const AnalysisOptions& options);
std::vector<Table> sphere_bases_tables(const AnalysisInput& input, const AnalysisOptions& options);

}  // namespace isostat
