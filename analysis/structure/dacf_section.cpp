#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <stdexcept>

#include "analysis/structure/correlation.hpp"
#include "analysis/structure/fit_json.hpp"
#include "analysis/structure/scattering_section.hpp"
#include "analysis/structure/sections.hpp"
#include "dem/input_error.hpp"
#include "geometry/pores.hpp"

namespace isostat {
namespace {

using Json = nlohmann::ordered_json;

// Steps of 1/20 diameter, then of 2 %, up to half the shorter edge; the same for all cells of one grain size.
std::vector<double> distances(double diameter, double end) {
  std::vector<double> r{0};
  while (r.back() + std::max(diameter / 20, 0.02 * r.back()) < end)
    r.push_back(r.back() + std::max(diameter / 20, 0.02 * r.back()));
  return r;
}

// Eq. 27 from one diameter to where the excess first vanishes, at most a quarter of the cell; or in the window asked
// for.
ExcessFits fits_asked_for(const AnalysisInput& input, const AnalysisOptions& options, double diameter, double shorter) {
  if (!options.r_window) return {{diameter, shorter / 4}, true, options.window_scan};
  if ((*options.r_window)[1] > shorter / 2 * (1 + 1e-12))
    throw InputError(
        input.path, 0, "--r-window", std::to_string((*options.r_window)[1]),
        "must end at half the shorter edge of the cell at the latest, " + std::to_string(shorter / 2) + " here");
  return {*options.r_window, false, options.window_scan};
}

// M(r) ~ r^d: the local slope d ln M / d ln r = 2 pi r^2 C / (Phi M), and the slope of a straight line in the window.
Json mass_radius(const CorrelationCurve& curve, double low, double high) {
  Json json;
  std::vector<double> slope;
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t k = 0; k < curve.r.size(); ++k) {
    const double r = curve.r[k], m = curve.mass[k];
    slope.push_back(r > 0 ? 2 * std::numbers::pi * r * r * curve.c[k] / (curve.solid_fraction * m) : 2);
    if (r < low || r > high || !(r > 0)) continue;
    const double x = std::log(r), y = std::log(m);
    n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  json["M"] = curve.mass;
  json["local_dimension"] = slope;
  json["dimension"] = n > 1 ? Json((n * sxy - sx * sy) / (n * sxx - sx * sx)) : Json();
  json["window"] = {low, high};
  return json;
}

CorrelationCurve correlation_of(const AnalysisInput& input, std::vector<double> r) {
  const auto& packing = input.packing();
  try {
    return density_correlation(packing.bodies.position, packing.bodies.radius, *packing.cell, std::move(r));
  } catch (const std::length_error& error) {
    throw InputError(input.path, 0, "dacf", "", std::string("the cell is too large for its grains: ") + error.what());
  }
}

}  // namespace

ExcessFits excess_fits(const Json& section) {
  const Json& fit = section.at("fit");
  return {{fit.at("r_from").get<double>(), fit.at("r_limit").get<double>()},
          fit.at("to_first_zero").get<bool>(),
          section.contains("windows")};
}

Excess excess_in(const Excess& all, const std::array<double, 2>& window, bool to_first_zero) {
  Excess in;
  for (std::size_t n = 0; n < all.r.size(); ++n) {
    if (all.r[n] < window[0] * (1 - 1e-12)) continue;
    if (all.r[n] > window[1] || (to_first_zero && all.value[n] <= 0)) break;
    in.r.push_back(all.r[n]), in.value.push_back(all.value[n]);
  }
  return in;
}

Json excess_fit_json(const FractalFit& fit, const ExcessFits& fits) {
  Json json = fit_json(fit);
  json["r_from"] = fits.window[0], json["r_limit"] = fits.window[1];
  json["to_first_zero"] = fits.to_first_zero;
  return json;
}

// Upper ends of a quarter of the window's to its own, then lower ends of twice and four times its own.
Json excess_windows(const Excess& excess, const ExcessFits& fits) {
  Json list = Json::array();
  const auto add = [&](double low, double high) {
    if (!(low < high)) return;
    const Excess in = excess_in(excess, {low, high}, fits.to_first_zero);
    list.push_back(window_of_fit(fit_correlation(in.r, in.value), {low, high}));
  };
  for (const double factor : {0.25, 0.5, std::sqrt(0.5), 1.0}) add(fits.window[0], factor * fits.window[1]);
  for (const double factor : {2.0, 4.0}) add(factor * fits.window[0], fits.window[1]);
  return list;
}

Json dacf_section(const AnalysisInput& input, const AnalysisOptions& options) {
  const auto& packing = input.packing();
  const auto& b = packing.bodies;
  const double diameter = grain_size(input);
  const double shorter = std::min(packing.cell->length[0], packing.cell->length[1]);
  const ExcessFits fits = fits_asked_for(input, options, diameter, shorter);
  const auto curve = correlation_of(input, distances(diameter, shorter / 2));
  Json json;
  json["r"] = curve.r, json["C"] = curve.c;
  json["solid_fraction"] = curve.solid_fraction;
  // C'(0) = -perimeter / (pi A), and the Porod tail I(k) -> -2 pi C'(0) / k^3.
  json["slope_at_0"] =
      -find_pores(b.position, b.radius, *packing.cell).perimeter / (std::numbers::pi * packing.cell->measure());
  json["k_cut"] = curve.k_cut;
  Excess excess{curve.r, curve.c};
  for (double& e : excess.value) e -= curve.solid_fraction * curve.solid_fraction;
  const Excess in = excess_in(excess, fits.window, fits.to_first_zero);
  json["fit"] = excess_fit_json(fit_correlation(in.r, in.value), fits);
  if (fits.scan) json["windows"] = excess_windows(excess, fits);
  const std::array<double, 2> sandbox =
      options.r_window ? *options.r_window : std::array{diameter, std::min(5 * diameter, shorter / 4)};
  json["mass_radius"] = mass_radius(curve, sandbox[0], sandbox[1]);
  json["cell_area"] = packing.cell->measure();
  return json;
}

}  // namespace isostat
