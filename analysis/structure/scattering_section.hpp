// What the sections about structure share: the length a of an input, and I(k) with its fit as JSON.
#pragma once
#include <nlohmann/json_fwd.hpp>

#include "analysis/input.hpp"
#include "analysis/structure/intensity.hpp"

namespace isostat {

// The length a: 1 in reduced units (AnalysisInput::has_law(); all samples share it), else the largest diameter. At
// least one grain.
double grain_size(const AnalysisInput& input);

// {"k_edges", "k", "I", "sigma", "modes", "fit": {...}} of a curve; k_limit: end of the fit window.
nlohmann::ordered_json scattering_json(const IntensityCurve& curve, const FractalFit& fit, double k_limit);

}  // namespace isostat
