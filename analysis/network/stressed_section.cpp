// Section "stressed": clusters of links that bear more than a threshold, their size law, and the compensation of
// tension and compression inside them, rim against inside (Gilabert 2007, Secs. IV.B.1 and IV.C, Figs. 11, 12, 19).
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "analysis/network/force_scale.hpp"
#include "analysis/network/histogram.hpp"
#include "analysis/network/sections.hpp"
#include "analysis/network/size_law.hpp"
#include "analysis/network/stressed_clusters.hpp"
#include "geometry/base/index.hpp"

namespace isostat {
namespace {

using Json = nlohmann::ordered_json;
constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();
constexpr double kHalfOctave = 0.5;  // bins of log2 of the number of grains
constexpr std::int64_t kSmallestOfLaw =
    4;  // grains of the smallest cluster that can be self-stressed by friction alone
constexpr int kDecades = 4, kPerDecade = 4;  // thresholds of the scan, from 1e-4 F1 to F1

double ratio(double a, double b) { return b != 0 ? a / b : kUndefined; }

// Part of a cluster (or of all): links, pressure in the measure of the clusters' grains, share of sum |N| r in tension.
template <int D>
Json part_json(const Virial& v, double measure) {
  return {{"links", v.links},
          {"pressure", ratio(v.sum, D * measure)},
          {"tensile_share", ratio(0.5 * (v.magnitude - v.sum), v.magnitude)}};
}

template <int D>
Json cluster_json(const Packing<D>& packing, const StressedCluster<D>& c) {
  Json json;
  json["first_grain"] = packing.bodies.id[idx(c.grains[0])];
  json["grains"] = c.grains.size(), json["links"] = c.links.size(), json["loops"] = c.loops();
  std::string spans;
  for (std::size_t k = 0; k < D; ++k)
    if (c.spans[k]) spans += "xyz"[k];
  json["spans"] = spans;
  json["area"] = c.measure;
  for (const Vec<D>& row : c.moment) {
    Json entries = Json::array();
    for (const double v : row.c) entries.push_back(ratio(v, c.measure));
    json["stress"].push_back(std::move(entries));
  }
  json["pressure"] = ratio(c.virial.sum, D * c.measure);
  json["compensation"] = 1 - ratio(std::abs(c.virial.sum), c.virial.magnitude);
  const auto pressure_at = [&](LinkPlace place) {
    return c.has_places ? ratio(c.at[static_cast<std::size_t>(place)].sum, D * c.measure) : kUndefined;
  };
  if constexpr (D == 2) {
    json["rim_pressure"] = pressure_at(LinkPlace::rim), json["inside_pressure"] = pressure_at(LinkPlace::inside);
    json["bridge_pressure"] = pressure_at(LinkPlace::bridge);
  }
  return json;
}

// Over the clusters that do not span: a spanning one is loaded from outside, and has no rim.
template <int D>
Json compensation_json(const Packing<D>& packing, const StressedClusters<D>& stressed) {
  double unbalanced = 0, magnitude = 0, measure = 0, placed_measure = 0;
  std::int64_t clusters = 0, tensile_rim = 0, compressed_rim = 0, one_sign = 0, placed = 0;
  std::array<Virial, kLinkPlaces> at;
  for (const StressedCluster<D>& c : stressed.clusters) {
    if (c.any_span()) continue;
    ++clusters, measure += c.measure;
    unbalanced += std::abs(c.virial.sum), magnitude += c.virial.magnitude;
    if (!c.has_places) continue;
    placed_measure += c.measure;
    for (std::size_t p = 0; p < kLinkPlaces; ++p) at[p].add(c.at[p]);
    const Virial &rim = c.at[static_cast<std::size_t>(LinkPlace::rim)],
                 &inside = c.at[static_cast<std::size_t>(LinkPlace::inside)];
    if (rim.links == 0 || inside.links == 0) continue;
    ++placed;
    (rim.sum < 0 && inside.sum > 0 ? tensile_rim : rim.sum > 0 && inside.sum < 0 ? compressed_rim : one_sign)++;
  }
  const Shuffled shuffled = shuffled_compensation(packing, stressed);
  Json json;
  json["clusters"] = clusters;
  json["value"] = 1 - ratio(unbalanced, magnitude);
  json["if_shuffled"] = shuffled.mean, json["if_shuffled_sd"] = shuffled.sd;
  if constexpr (D == 2) {
    json["with_inside"] = placed;
    json["tensile_rim"] = tensile_rim, json["compressed_rim"] = compressed_rim, json["same_sign"] = one_sign;
    json["rim"] = part_json<D>(at[static_cast<std::size_t>(LinkPlace::rim)], placed_measure);
    json["inside"] = part_json<D>(at[static_cast<std::size_t>(LinkPlace::inside)], placed_measure);
    json["bridges"] = part_json<D>(at[static_cast<std::size_t>(LinkPlace::bridge)], placed_measure);
  }
  return json;
}

Json size_histogram(const std::vector<std::int64_t>& sizes) {
  if (sizes.empty()) return Json::object();
  std::vector<double> log_size;
  for (const std::int64_t n : sizes) log_size.push_back(std::log2(static_cast<double>(n)));
  const Histogram h = anchored_histogram(log_size, kHalfOctave);
  return {{"log2_size", {{"edges", h.edges}, {"density", h.density}}}};
}

template <int D>
void add_scan(Json& json, const Packing<D>& packing, ForceMeasure measure, double scale) {
  for (int k = -kDecades * kPerDecade; k <= 0; ++k) {
    const ClusterCounts c =
        count_clusters_above(packing, measure, scale * std::pow(10.0, static_cast<double>(k) / kPerDecade));
    json["above"].push_back(c.threshold), json["above_links"].push_back(c.links);
    json["above_clusters"].push_back(c.clusters), json["above_largest"].push_back(c.largest);
    json["above_mean_size"].push_back(c.mean_size);
    json["above_mean_size_weighted"].push_back(c.mean_size_weighted);
    json["above_spanning"].push_back(c.spanning);
  }
}

template <int D>
Json stressed_of(const Packing<D>& packing, const AnalysisInput& input, const AnalysisOptions& options) {
  const ForceReading reading = read_forces(input);
  const double threshold = options.threshold.value_or(0.01 * reading.scale);
  const StressedClusters<D> stressed = stressed_clusters(packing, options.force_measure, threshold);
  const ClusterCounts counts = count_clusters_above(packing, options.force_measure, threshold);
  std::int64_t grains = 0, spanning_grains = 0, links = 0;
  std::vector<std::int64_t> sizes, finite;
  for (const StressedCluster<D>& c : stressed.clusters) {
    sizes.push_back(std::ssize(c.grains)), grains += std::ssize(c.grains);
    if (c.any_span())
      spanning_grains += std::ssize(c.grains);
    else
      finite.push_back(std::ssize(c.grains));
  }
  for (const Link<D>& link : packing.links) links += link.kind != LinkKind::beam;
  Json json;
  json["threshold"] = threshold;
  json["measure"] = options.force_measure == ForceMeasure::normal ? "normal" : "total";
  json["links"] = counts.links, json["share_of_links"] = ratio(double(counts.links), double(links));
  json["grains"] = grains, json["share_of_grains"] = ratio(double(grains), double(count_free(packing)));
  json["count"] = counts.clusters, json["largest"] = counts.largest;
  json["mean_size"] = counts.mean_size, json["mean_size_weighted"] = counts.mean_size_weighted;
  json["spanning"] = counts.spanning, json["grains_in_spanning"] = spanning_grains;
  json["compensation"] = compensation_json(packing, stressed);
  json["size_law"] = size_law_json(discrete_size_law(
      finite, kSmallestOfLaw, std::max<std::int64_t>(kSmallestOfLaw, static_cast<std::int64_t>(count_free(packing)))));
  json["histograms"] = size_histogram(sizes);
  add_scan(json, packing, options.force_measure, reading.scale);
  json["list"] = Json::array();
  for (const StressedCluster<D>& c : stressed.clusters) json["list"].push_back(cluster_json(packing, c));
  return json;
}

}  // namespace

Json stressed_section(const AnalysisInput& input, const AnalysisOptions& options) {
  return input.packing_3d ? stressed_of(*input.packing_3d, input, options)
                          : stressed_of(input.packing(), input, options);
}

}  // namespace isostat
