#include "analysis/structure/scattering_section.hpp"

#include <algorithm>
#include <cmath>
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

// Fit window used throughout: from the first bin to one wave per largest grain diameter; beyond, I(k) shows the shape
// of the grains and not their arrangement.
double fit_limit(const AnalysisInput& input) { return 2 * kPi / grain_size(input); }

// Edges are anchored at k_max (0: 4 pi / a; 20 a decade) down to below 2 pi / (longest edge of the cell).
IntensityCurve scattering_curve(const AnalysisInput& input, double k_max) {
  const auto& packing = input.packing();
  const auto& b = packing.bodies;
  if (k_max == 0) k_max = 2 * fit_limit(input);
  const double k_min = 2 * kPi / std::max(packing.cell->length[0], packing.cell->length[1]);
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

}  // namespace

double grain_size(const AnalysisInput& input) {
  const auto& radius = input.packing().bodies.radius;
  const double largest = 2 * *std::max_element(radius.begin(), radius.end());
  return input.has_law() ? std::max(1.0, largest) : largest;
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

}  // namespace isostat
