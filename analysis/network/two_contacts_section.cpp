// Section "two_contacts": |T/N| of grains with two loaded contacts against the line through their contact points, and
// against Eq. 20 where the two neighbours touch (Gilabert 2007, Sec. IV.B.3, Figs. 14, 16, 17).
#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "analysis/network/force_scale.hpp"
#include "analysis/network/histogram.hpp"
#include "analysis/network/sections.hpp"
#include "analysis/network/two_contacts.hpp"
#include "geometry/base/index.hpp"

namespace isostat {
namespace {

using Json = nlohmann::ordered_json;
constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();
constexpr double kLeastDeviation = 1e-12;  // smaller ones count as this in the histogram
constexpr double kHistogramBin = 0.25;     // of log10 of the deviation

// |T/N| / predicted - 1. A prediction of 0 (contacts opposite each other, no T) has none; N = 0 is infinitely far.
double deviation_of(const TwoContact& c) { return c.predicted > 0 ? std::abs(c.ratio / c.predicted - 1) : kUndefined; }

Json statistics(const std::vector<TwoContact>& all, bool touching) {
  std::vector<double> deviation, ratio;
  for (const TwoContact& c : all)
    if (c.touching == touching && std::isfinite(deviation_of(c)))
      deviation.push_back(deviation_of(c)), ratio.push_back(c.ratio);
  std::int64_t contacts = 0;
  for (const TwoContact& c : all) contacts += c.touching == touching;
  std::sort(deviation.begin(), deviation.end());
  const auto quantile = [&](double q) {  // linear between order statistics
    if (deviation.empty()) return kUndefined;
    const double at = q * static_cast<double>(deviation.size() - 1);
    const auto below = static_cast<std::size_t>(at), above = std::min(below + 1, deviation.size() - 1);
    return deviation[below] + (at - static_cast<double>(below)) * (deviation[above] - deviation[below]);
  };
  const auto within = [&](double limit) {
    if (deviation.empty()) return kUndefined;
    const auto n = std::upper_bound(deviation.begin(), deviation.end(), limit) - deviation.begin();
    return static_cast<double>(n) / static_cast<double>(deviation.size());
  };
  double sum = 0, ratios = 0;
  for (const double d : deviation) sum += d / static_cast<double>(deviation.size());
  for (const double v : ratio) ratios += v / static_cast<double>(ratio.size());
  Json json;
  json["grains"] = contacts / 2;
  json["mean_ratio"] = ratio.empty() ? kUndefined : ratios;
  json["median_deviation"] = quantile(0.5), json["mean_deviation"] = deviation.empty() ? kUndefined : sum;
  json["deviation_90"] = quantile(0.9), json["largest_deviation"] = quantile(1);
  json["within_1_percent"] = within(0.01), json["within_10_percent"] = within(0.1);
  return json;
}

Json histogram_of(const std::vector<TwoContact>& all, bool touching) {
  std::vector<double> logs;
  for (const TwoContact& c : all)
    if (c.touching == touching && std::isfinite(deviation_of(c)))
      logs.push_back(std::log10(std::max(deviation_of(c), kLeastDeviation)));
  if (logs.empty()) return nullptr;
  const Histogram h = anchored_histogram(logs, kHistogramBin);
  return {{"edges", h.edges}, {"density", h.density}};
}

std::vector<TwoContact> found_in(const AnalysisInput& input) {
  const double loaded = read_forces(input).threshold;
  return input.packing_3d ? two_contacts(*input.packing_3d, loaded) : two_contacts(input.packing(), loaded);
}

template <int D>
std::vector<std::vector<double>> lines(const Packing<D>& packing, const std::vector<TwoContact>& found) {
  std::vector<std::vector<double>> rows;
  const auto id = [&](std::int32_t body) { return static_cast<double>(packing.bodies.id[idx(body)]); };
  const auto radius = [&](std::int32_t body) { return packing.bodies.radius[idx(body)]; };
  for (const TwoContact& c : found)
    rows.push_back({id(c.grain), id(c.neighbour), id(c.other), radius(c.grain), radius(c.neighbour), radius(c.other),
                    double(c.touching), packing.links[idx(c.link)].normal_force, c.ratio, c.predicted});
  return rows;
}

}  // namespace

Json two_contacts_section(const AnalysisInput& input, const AnalysisOptions&) {
  const std::vector<TwoContact> found = found_in(input);
  Json json;
  json["grains"] = found.size() / 2;
  json["touching"] = statistics(found, true);
  json["apart"] = statistics(found, false);
  json["histograms"] = Json::object();
  for (const bool touching : {true, false})
    if (Json h = histogram_of(found, touching); !h.is_null())
      json["histograms"][touching ? "log10_deviation_touching" : "log10_deviation_apart"] = std::move(h);
  return json;
}

std::vector<Table> two_contacts_tables(const AnalysisInput& input, const AnalysisOptions&) {
  Table table{"contacts",
              {"id", "neighbour", "other", "R", "R_neighbour", "R_other", "touching", "N", "ratio", "predicted"},
              {}};
  const std::vector<TwoContact> found = found_in(input);
  table.rows = input.packing_3d ? lines(*input.packing_3d, found) : lines(input.packing(), found);
  return {table};
}

}  // namespace isostat
