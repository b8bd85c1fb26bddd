// I(k) of one packing or of several of different size, for the report and for whoever needs the curves themselves.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <vector>

#include "analysis/input.hpp"
#include "analysis/structure/intensity.hpp"

namespace isostat {

// The length a: 1 in a state (reduced units, so that all samples share it), else the largest diameter. At least one
// grain.
double grain_size(const AnalysisInput& input);

// Curve of one planar periodic input; throws InputError otherwise. k_max 0: 4 pi / a. Edges are
// anchored at k_max (20 a decade) down to below 2 pi / (longest edge of the cell), or to below k_min if that is given.
IntensityCurve scattering_curve(const AnalysisInput& input, double k_max, double k_min = 0);

// Fit window used throughout: from the first bin to one wave per largest grain diameter; beyond, I(k) shows the shape
// of the grains and not their arrangement.
double fit_limit(const AnalysisInput& input);

// {"k_edges", "k", "I", "sigma", "modes", "fit": {...}} of a curve; k_limit: end of the fit window.
nlohmann::ordered_json scattering_json(const IntensityCurve& curve, const FractalFit& fit, double k_limit);

// Several states, whatever their sizes, in one curve on common edges; all modes count alike.
nlohmann::ordered_json scattering_ensemble(std::span<const AnalysisInput> inputs, const AnalysisOptions& options);

}  // namespace isostat
