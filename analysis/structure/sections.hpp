// Sections of `analyze` about the void and the density correlations (docs/structure.md has every key).
#pragma once
#include <nlohmann/json_fwd.hpp>

#include "analysis/report.hpp"

namespace isostat {

// Pores of the union of disks; --gap-tolerance closes gaps up to it (default 0). Gilabert 2007, Sec. V.B, Eqs. 29-30.
nlohmann::ordered_json pores_section(const AnalysisInput& input, const AnalysisOptions& options);

}  // namespace isostat
