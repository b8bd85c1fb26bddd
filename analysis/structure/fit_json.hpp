// A fit of a fractal law as JSON: the contract's keys, then what tells whether to believe it.
#pragma once
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "analysis/structure/fractal_fit.hpp"

namespace isostat {

// Undefined numbers are null, in memory too: averages over samples leave nulls out.
inline nlohmann::ordered_json defined(double value) {
  return std::isnan(value) ? nlohmann::ordered_json() : nlohmann::ordered_json(value);
}
inline nlohmann::ordered_json defined(const std::vector<double>& values) {
  auto json = nlohmann::ordered_json::array();
  for (const double v : values) json.push_back(defined(v));
  return json;
}

inline nlohmann::ordered_json fit_json(const FractalFit& f) {
  nlohmann::ordered_json json;
  json["d_F"] = defined(f.d_f), json["d_F_error"] = defined(f.error[0]);
  json["xi"] = defined(f.xi), json["xi_error"] = defined(f.error[1]);
  json["amplitude"] = defined(f.amplitude), json["amplitude_error"] = defined(f.error[2]);
  json["constant"] = defined(f.constant), json["constant_error"] = defined(f.error[3]);
  json["chi2_per_dof"] = defined(f.chi2_per_dof());
  json["points"] = f.points;
  json["window"] = {f.window[0], f.window[1]};
  for (const auto& row : f.correlation)
    json["correlation"].push_back(
        defined(std::vector<double>(row.begin(), row.end())));  // of d_F, xi, amplitude, constant
  json["starts"] = f.starts, json["agreeing_starts"] = f.agreeing;
  json["identifiable"] = f.identifiable;
  json["message"] = f.message;
  return json;
}

// One line of a scan over windows.
inline nlohmann::ordered_json window_of_fit(const FractalFit& f, const std::array<double, 2>& window) {
  return {{"from", window[0]},
          {"to", window[1]},
          {"points", f.points},
          {"d_F", defined(f.d_f)},
          {"d_F_error", defined(f.error[0])},
          {"xi", defined(f.xi)},
          {"xi_error", defined(f.error[1])},
          {"constant", defined(f.constant)},
          {"chi2_per_dof", defined(f.chi2_per_dof())},
          {"identifiable", f.identifiable},
          {"message", f.message}};
}

}  // namespace isostat
