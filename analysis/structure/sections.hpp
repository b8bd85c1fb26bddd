// Sections of `analyze` about the void and the density correlations (docs/structure.md has every key).
#pragma once
#include <nlohmann/json_fwd.hpp>

#include "analysis/input.hpp"

namespace isostat {

// Pores of the union of disks; --gap-tolerance closes gaps up to it (default 0). Gilabert 2007, Sec. V.B, Eqs. 29-30.
nlohmann::ordered_json pores_section(const AnalysisInput& input, const AnalysisOptions& options);

// I(k) binned over the reciprocal lattice up to --k-max, and the fit of Eq. 28.
nlohmann::ordered_json scattering_section(const AnalysisInput& input, const AnalysisOptions& options);

// Density autocorrelation C(r), the fit of Eq. 27, and the mass-radius relation.
nlohmann::ordered_json dacf_section(const AnalysisInput& input, const AnalysisOptions& options);

// Radial distribution function of spheres up to five largest diameters, bins of 1/40 of them.
nlohmann::ordered_json rdf_section(const AnalysisInput& input, const AnalysisOptions& options);

}  // namespace isostat
