#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>

#include "analysis/network/histogram.hpp"
#include "analysis/network/size_law.hpp"
#include "analysis/structure/fit_json.hpp"
#include "analysis/structure/scattering_section.hpp"
#include "analysis/structure/sections.hpp"
#include "geometry/pores.hpp"

namespace isostat {
namespace {

constexpr double kDecadeBin = 0.1;  // width of the bins of log10 R_H

// Walls are left out: a pore is enclosed by grains.
Pores pores_of(const Packing<2>& packing, const PoreOptions& options) {
  const auto grains = static_cast<std::size_t>(LinkNetwork(packing).free);
  const std::span centre(packing.bodies.position.data(), grains);
  const std::span radius(packing.bodies.radius.data(), grains);
  return packing.cell ? find_pores(centre, radius, *packing.cell, options)
                      : find_enclosed_pores(centre, radius, options);
}

nlohmann::ordered_json as_json(const Pore& p, const Pores& all) {
  nlohmann::ordered_json json;
  if (p.percolating) {  // neither area nor centre: it has no end
    json = {{"x", nullptr}, {"y", nullptr}, {"gyration", nullptr}, {"R", nullptr}, {"percolating", true}};
    json["along"] = {p.along[0], p.along[1]};
    return json;
  }
  const Vec2 c = all.cell.wrap(p.centroid);
  json = {
      {"area", p.area},      {"x", c[0]}, {"y", c[1]}, {"gyration", p.gyration}, {"R", defined(p.equivalent_radius)},
      {"percolating", false}};
  return json;
}

// Size distribution by number, and weighted by area as the mean of Eq. 30 is.
nlohmann::ordered_json distributions(const Pores& pores) {
  std::vector<double> log_radius, area;
  double total = 0;
  for (const auto& p : pores.pores) {
    if (p.percolating || !(p.equivalent_radius > 0)) continue;
    log_radius.push_back(std::log10(p.equivalent_radius)), area.push_back(p.area);
    total += p.area;
  }
  if (log_radius.empty()) return nlohmann::ordered_json::object();
  const auto number = anchored_histogram(log_radius, kDecadeBin);
  std::vector<double> weighted(number.density.size(), 0);
  for (std::size_t k = 0; k < log_radius.size(); ++k) {
    auto bin = static_cast<std::size_t>(std::upper_bound(number.edges.begin(), number.edges.end(), log_radius[k]) -
                                        number.edges.begin()) -
               1;
    bin = std::min(bin, weighted.size() - 1);
    weighted[bin] += area[k] / (total * (number.edges[bin + 1] - number.edges[bin]));
  }
  nlohmann::ordered_json json;
  json["log10_R"] = {{"edges", number.edges}, {"density", number.density}};
  json["log10_R_by_area"] = {{"edges", number.edges}, {"density", weighted}};
  return json;
}

// Radii of the finite pores that have one.
std::vector<double> radii_of(const Pores& pores) {
  std::vector<double> radii;
  for (const auto& p : pores.pores)
    if (!p.percolating && p.equivalent_radius > 0) radii.push_back(p.equivalent_radius);
  return radii;
}

double largest_diameter(const AnalysisInput& input) { return input.grains() > 0 ? grain_size(input) : 1; }

// How much of the void is in pores with R below a size: of the finite pores', as the mean of Eq. 30 weighs them, and of
// all void, percolating pores included.
nlohmann::ordered_json small_pores(const AnalysisInput& input, const AnalysisOptions& options, const Pores& pores) {
  const double size = options.pore_size.value_or(largest_diameter(input));
  std::int64_t count = 0;
  double area = 0, finite = 0;
  for (const auto& p : pores.pores) {
    if (p.percolating) continue;
    finite += p.area;
    if (p.equivalent_radius < size) ++count, area += p.area;
  }
  const double cell = input.packing().cell ? input.packing().cell->measure() : std::nan("");
  nlohmann::ordered_json json;
  json["size"] = size, json["count"] = count, json["area"] = area;
  json["share"] = defined(area / finite), json["share_of_void"] = defined(area / (cell - pores.covered_area));
  return json;
}

// Of the number of pores against R. By default from a/2: what three or four disks enclose is smaller, and its number
// follows from how disks touch.
nlohmann::ordered_json size_law_of(const AnalysisInput& input, const AnalysisOptions& options, const Pores& pores) {
  const SizeLawFit law =
      options.pore_window ? continuous_size_law(radii_of(pores), (*options.pore_window)[0], (*options.pore_window)[1])
                          : continuous_size_law(radii_of(pores), 0.5 * largest_diameter(input));
  return size_law_json(law);
}

}  // namespace

nlohmann::ordered_json pores_section(const AnalysisInput& input, const AnalysisOptions& options) {
  const auto& packing = input.packing();
  const double tolerance = options.gap_tolerance.value_or(0);
  const auto pores = pores_of(packing, {.gap_tolerance = tolerance});
  nlohmann::ordered_json json;
  std::size_t percolating = 0;
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const auto& p : pores.pores) {
    percolating += p.percolating;
    list.push_back(as_json(p, pores));
  }
  json["count"] = pores.pores.size();
  json["mean_radius_weighted"] = defined(mean_radius_weighted(pores.pores));
  json["percolating"] = percolating;
  json["gap_tolerance"] = tolerance;
  json["covered_area"] = pores.covered_area;
  json["perimeter"] = pores.perimeter;
  json["small"] = small_pores(input, options, pores);
  json["size_law"] = size_law_of(input, options, pores);
  json["histograms"] = distributions(pores);
  json["list"] = std::move(list);
  return json;
}

}  // namespace isostat
