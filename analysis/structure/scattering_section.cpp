#include "analysis/structure/scattering_section.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <stdexcept>

#include "analysis/structure/fit_json.hpp"
#include "analysis/structure/sections.hpp"
#include "dem/input_error.hpp"

namespace isostat {
namespace {

using Json = nlohmann::ordered_json;
constexpr double kPi = std::numbers::pi;

double number_or_nan(const Json& j) {
  return j.is_number() ? j.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

std::vector<double> numbers(const Json& j) {
  std::vector<double> out;
  for (const auto& v : j) out.push_back(number_or_nan(v));
  return out;
}

IntensityCurve curve_of(const Json& j) {
  return {numbers(j["k_edges"]), numbers(j["k"]), numbers(j["I"]), numbers(j["sigma"]),
          j["modes"].get<std::vector<std::int64_t>>()};
}

}  // namespace

double fit_limit(const AnalysisInput& input) {
  const auto& radius = input.planar("scattering").bodies.radius;
  return 2 * kPi / (2 * *std::max_element(radius.begin(), radius.end()));
}

IntensityCurve scattering_curve(const AnalysisInput& input, double k_max, double k_min) {
  const auto& packing = input.planar("scattering");
  const auto& b = packing.bodies;
  if (!packing.cell) refuse_section(input, "scattering", "needs a periodic cell: I(k) lives on its reciprocal lattice");
  if (b.size() == 0) refuse_section(input, "scattering", "needs at least one grain");
  if (k_max == 0) k_max = 2 * fit_limit(input);
  if (k_min == 0) k_min = 2 * kPi / std::max(packing.cell->length[0], packing.cell->length[1]);
  if (!(k_max > k_min))
    throw InputError(input.path, 0, "--k-max", std::to_string(k_max),
                     "must exceed the smallest wave number of the cell, " + std::to_string(k_min));
  try {
    return average_intensity(disk_transform(b.position, b.radius, *packing.cell, {.k_max = k_max}),
                             anchored_edges(k_min, k_max));
  } catch (const std::length_error& error) {
    throw InputError(input.path, 0, "--k-max", std::to_string(k_max), error.what());
  }
}

Json scattering_json(const IntensityCurve& c, const FractalFit& fit, double k_limit) {
  Json json;
  json["k_edges"] = c.k_edges, json["k"] = c.k, json["I"] = c.intensity, json["sigma"] = c.sigma,
  json["modes"] = c.modes;
  json["fit"] = fit_json(fit);
  json["fit"]["k_limit"] = k_limit;
  return json;
}

Json scattering_section(const AnalysisInput& input, const AnalysisOptions& options) {
  const auto curve = scattering_curve(input, options.k_max);
  const double limit = fit_limit(input);
  return scattering_json(curve, fit_curve(curve, 0, limit), limit);
}

Json scattering_ensemble(std::span<const AnalysisInput> inputs, const AnalysisOptions& options) {
  double k_max = options.k_max, k_min = std::numeric_limits<double>::infinity(), limit = k_min;
  for (const auto& input : inputs) {
    const auto& packing = input.planar("scattering");
    if (!packing.cell || packing.bodies.size() == 0) scattering_curve(input, k_max);  // throws
    limit = std::min(limit, fit_limit(input));
    k_min = std::min(k_min, 2 * kPi / std::max(packing.cell->length[0], packing.cell->length[1]));
  }
  if (k_max == 0) k_max = 2 * limit;
  std::vector<IntensityCurve> curves;
  for (const auto& input : inputs) curves.push_back(scattering_curve(input, k_max, k_min));
  const auto pooled = pooled_intensity(curves);
  return scattering_json(pooled, fit_curve(pooled, 0, limit), limit);
}

bool align_scattering(std::vector<Json>& sections) {
  std::size_t longest = 0;
  for (std::size_t n = 0; n < sections.size(); ++n)
    if (sections[n]["k_edges"].size() > sections[longest]["k_edges"].size()) longest = n;
  const Json edges = sections[longest]["k_edges"];
  for (const auto& s : sections) {
    const auto offset = edges.size() - s["k_edges"].size();
    for (std::size_t k = 0; k < s["k_edges"].size(); ++k)
      if (std::abs(s["k_edges"][k].get<double>() / edges[k + offset].get<double>() - 1) > 1e-12) return false;
  }
  for (auto& s : sections) {
    const auto missing = static_cast<std::ptrdiff_t>(edges.size() - s["k_edges"].size());
    for (const char* key : {"k", "I", "sigma", "modes"}) {
      Json padded = Json::array();
      for (std::ptrdiff_t n = 0; n < missing; ++n) padded.push_back(std::string(key) == "modes" ? Json(0) : Json());
      for (const auto& v : s[key]) padded.push_back(v);
      s[key] = std::move(padded);
    }
    s["k_edges"] = edges;
  }
  return true;
}

Json pooled_scattering(const std::vector<Json>& sections) {
  std::vector<IntensityCurve> curves;
  double limit = std::numeric_limits<double>::infinity();
  for (const auto& s : sections) {
    curves.push_back(curve_of(s));
    limit = std::min(limit, number_or_nan(s["fit"]["k_limit"]));
  }
  const auto pooled = pooled_intensity(curves);
  return scattering_json(pooled, fit_curve(pooled, 0, limit), limit);
}

}  // namespace isostat
