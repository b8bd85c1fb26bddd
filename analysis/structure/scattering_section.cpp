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
// of the grains and not their arrangement. Of Eq. 26 from 2 pi / (10 a): there the paper sees the bump at which the
// fractal range ends.
constexpr double kFractalRange = 10;  // [a]
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

ScatteringFits fits_asked_for(const AnalysisInput& input, const AnalysisOptions& options, double k_max) {
  ScatteringFits fits;
  fits.constant = options.fit_constant, fits.scan = options.window_scan;
  const double limit = fit_limit(input);
  fits.window = {0, limit}, fits.power_window = {limit / kFractalRange, limit};
  if (!options.k_window) return fits;
  fits.window = fits.power_window = *options.k_window;
  if (fits.window[1] > k_max * (1 + 1e-12))
    throw InputError(input.path, 0, "--k-window", std::to_string(fits.window[1]),
                     "must end at --k-max at the latest, " + std::to_string(k_max) + " here");
  return fits;
}

// Upper ends of half to twice the window's, then lower ends of twice and four times its first point.
std::vector<std::array<double, 2>> other_windows(const IntensityCurve& c, const std::array<double, 2>& window) {
  std::vector<std::array<double, 2>> windows;
  for (const double factor : {0.5, std::sqrt(0.5), 1.0, std::sqrt(2.0), 2.0})
    if (factor * window[1] <= c.k_edges.back() * (1 + 1e-12)) windows.push_back({window[0], factor * window[1]});
  for (std::size_t b = 0; b < c.modes.size(); ++b) {
    if (c.modes[b] == 0 || c.k[b] < window[0]) continue;
    for (const double factor : {2.0, 4.0}) windows.push_back({factor * c.k[b], window[1]});
    break;
  }
  return windows;
}

Json power_json(const PowerFit& f, const std::array<double, 2>& asked) {
  return {{"d_F", defined(f.exponent)},
          {"d_F_error", defined(f.error)},
          {"amplitude", defined(f.amplitude)},
          {"slope_change", defined(f.slope_change)},
          {"slope_change_error", defined(f.slope_change_error)},
          {"chi2_per_dof", defined(f.chi2_per_dof)},
          {"points", f.points},
          {"window", {f.window[0], f.window[1]}},
          {"asked_window", {asked[0], asked[1]}},
          {"identifiable", f.identifiable},
          {"message", f.message}};
}

Json window_json(const IntensityCurve& c, const std::array<double, 2>& window, FitConstant constant) {
  const FractalFit fit = fit_curve(c, window[0], window[1], constant);
  const PowerFit power = fit_curve_power(c, window[0], window[1]);
  Json json = window_of_fit(fit, window);
  json["power_d_F"] = defined(power.exponent), json["power_d_F_error"] = defined(power.error);
  json["power_identifiable"] = power.identifiable;
  return json;
}

}  // namespace

double grain_size(const AnalysisInput& input) {
  const auto& radius = input.packing().bodies.radius;
  const double largest = 2 * *std::max_element(radius.begin(), radius.end());
  return input.has_law() ? std::max(1.0, largest) : largest;
}

ScatteringFits scattering_fits(const Json& section) {
  ScatteringFits fits;
  const Json &fit = section.at("fit"), &power = section.at("power");
  fits.window = {fit.at("k_from").get<double>(), fit.at("k_limit").get<double>()};
  fits.power_window = power.at("asked_window").get<std::array<double, 2>>();
  fits.constant = fit_constant_named(fit.at("constant_is").get<std::string>()).value();
  fits.scan = section.contains("windows");
  return fits;
}

Json scattering_json(const IntensityCurve& c, const FractalFit& fit, const ScatteringFits& fits) {
  Json json;
  json["k_edges"] = c.k_edges, json["k"] = c.k, json["I"] = c.intensity, json["sigma"] = c.sigma,
  json["modes"] = c.modes;
  json["fit"] = fit_json(fit);
  json["fit"]["k_from"] = fits.window[0], json["fit"]["k_limit"] = fits.window[1];
  json["fit"]["constant_is"] = name_of(fits.constant);
  json["power"] = power_json(fit_curve_power(c, fits.power_window[0], fits.power_window[1]), fits.power_window);
  if (!fits.scan) return json;
  json["windows"] = Json::array();
  for (const auto& window : other_windows(c, fits.window))
    json["windows"].push_back(window_json(c, window, fits.constant));
  return json;
}

Json scattering_section(const AnalysisInput& input, const AnalysisOptions& options) {
  const auto curve = scattering_curve(input, options.k_max);
  const ScatteringFits fits = fits_asked_for(input, options, curve.k_edges.back());
  return scattering_json(curve, fit_curve(curve, fits.window[0], fits.window[1], fits.constant), fits);
}

}  // namespace isostat
