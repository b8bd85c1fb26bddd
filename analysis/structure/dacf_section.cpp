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

// Eq. 27 from one diameter to where the excess first vanishes, at most a quarter of the cell.
FractalFit fit_excess(const CorrelationCurve& curve, double diameter, double end) {
  std::vector<double> r, excess;
  for (std::size_t n = 0; n < curve.r.size(); ++n) {
    const double e = curve.c[n] - curve.solid_fraction * curve.solid_fraction;
    if (curve.r[n] < diameter * (1 - 1e-12)) continue;
    if (curve.r[n] > end || e <= 0) break;
    r.push_back(curve.r[n]), excess.push_back(e);
  }
  return fit_correlation(r, excess);
}

// M(r) ~ r^d: the local slope d ln M / d ln r = 2 pi r^2 C / (Phi M), and the slope of a straight line in the window.
Json mass_radius(const CorrelationCurve& curve, double low, double high) {
  Json json;
  std::vector<double> slope;
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t k = 0; k < curve.r.size(); ++k) {
    const double r = curve.r[k], m = curve.mass[k];
    slope.push_back(r > 0 ? 2 * std::numbers::pi * r * r * curve.c[k] / (curve.solid_fraction * m) : 2);
    if (r < low || r > high) continue;
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

Json dacf_section(const AnalysisInput& input, const AnalysisOptions&) {
  const auto& packing = input.packing();
  const auto& b = packing.bodies;
  const double diameter = grain_size(input);
  const double shorter = std::min(packing.cell->length[0], packing.cell->length[1]);
  const auto curve = correlation_of(input, distances(diameter, shorter / 2));
  Json json;
  json["r"] = curve.r, json["C"] = curve.c;
  json["solid_fraction"] = curve.solid_fraction;
  // C'(0) = -perimeter / (pi A), and the Porod tail I(k) -> -2 pi C'(0) / k^3.
  json["slope_at_0"] =
      -find_pores(b.position, b.radius, *packing.cell).perimeter / (std::numbers::pi * packing.cell->measure());
  json["k_cut"] = curve.k_cut;
  json["fit"] = fit_json(fit_excess(curve, diameter, shorter / 4));
  json["mass_radius"] = mass_radius(curve, diameter, std::min(5 * diameter, shorter / 4));
  return json;
}

}  // namespace isostat
