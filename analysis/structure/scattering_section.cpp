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

}  // namespace

double grain_size(const AnalysisInput& input) {
  const auto& radius = input.packing.bodies.radius;
  const double largest = 2 * *std::max_element(radius.begin(), radius.end());
  return input.state ? std::max(1.0, largest) : largest;
}

double fit_limit(const AnalysisInput& input) { return 2 * kPi / grain_size(input); }

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

}  // namespace isostat
