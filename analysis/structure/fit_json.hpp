// A fit of a fractal law as JSON: the contract's keys, then what tells whether to believe it.
#pragma once
#include <nlohmann/json.hpp>

#include "analysis/structure/fractal_fit.hpp"

namespace isostat {

inline nlohmann::ordered_json fit_json(const FractalFit& f) {
  nlohmann::ordered_json json;
  json["d_F"] = f.d_f, json["d_F_error"] = f.error[0];
  json["xi"] = f.xi, json["xi_error"] = f.error[1];
  json["amplitude"] = f.amplitude, json["amplitude_error"] = f.error[2];
  json["constant"] = f.constant, json["constant_error"] = f.error[3];
  json["chi2_per_dof"] = f.chi2_per_dof();
  json["points"] = f.points;
  json["window"] = {f.window[0], f.window[1]};
  json["correlation"] = f.correlation;  // of d_F, xi, amplitude, constant
  json["starts"] = f.starts, json["agreeing_starts"] = f.agreeing;
  json["identifiable"] = f.identifiable;
  json["message"] = f.message;
  return json;
}

}  // namespace isostat
