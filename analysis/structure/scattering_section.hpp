// What the sections about structure share: the length a of an input, and I(k) and C(r) with their fits as JSON. Which
// fits were asked for stands in the JSON, so that the curves of several inputs can be fitted together alike.
#pragma once
#include <nlohmann/json_fwd.hpp>

#include "analysis/input.hpp"
#include "analysis/structure/intensity.hpp"

namespace isostat {

// The length a: 1 in reduced units (AnalysisInput::has_law(); all samples share it), else the largest diameter. At
// least one grain.
double grain_size(const AnalysisInput& input);

struct ScatteringFits {
  std::array<double, 2> window{};        // [1/length] of Eq. 28
  std::array<double, 2> power_window{};  // [1/length] of Eq. 26
  FitConstant constant = FitConstant::free;
  bool scan = false;  // other windows, too
};
// As they stand in a report.
ScatteringFits scattering_fits(const nlohmann::ordered_json& section);

// {"k_edges", "k", "I", "sigma", "modes", "fit": {...}, "power": {...}} of a curve, and "windows" where asked for.
nlohmann::ordered_json scattering_json(const IntensityCurve& curve, const FractalFit& fit, const ScatteringFits& fits);

// C(r) - Phi^2 with its fit of Eq. 27.
struct ExcessFits {
  std::array<double, 2> window{};  // [length]
  bool to_first_zero = true;       // ends where the excess first vanishes; false: a window that was asked for
  bool scan = false;
};
ExcessFits excess_fits(const nlohmann::ordered_json& section);
struct Excess {
  std::vector<double> r, value;
};
Excess excess_in(const Excess& all, const std::array<double, 2>& window, bool to_first_zero);
// {"d_F", ...} of the fit of the points in the window, and the same in other windows.
nlohmann::ordered_json excess_fit_json(const FractalFit& fit, const ExcessFits& fits);
nlohmann::ordered_json excess_windows(const Excess& excess, const ExcessFits& fits);

}  // namespace isostat
