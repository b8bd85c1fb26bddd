#include "analysis/network/stressed_clusters.hpp"

#include <limits>
#include <map>
#include <numbers>
#include <random>

#include "analysis/network/force_scale.hpp"
#include "analysis/network/link_places.hpp"
#include "dem/state/link_ends.hpp"
#include "geometry/base/index.hpp"
#include "geometry/placed_sets.hpp"

namespace isostat {
namespace {

// Between grains: beams hold one grain together, walls are none.
template <int D>
bool may_be_stressed(const Packing<D>& packing, const Link<D>& link) {
  return link.kind != LinkKind::beam && is_free(packing.part, idx(link.i)) && is_free(packing.part, idx(link.j));
}

double measure_of(const Vec2&, double radius) { return std::numbers::pi * radius * radius; }
double measure_of(const Vec3&, double radius) { return 4 * std::numbers::pi / 3 * radius * radius * radius; }

Vec2 tangential_force(const Link<2>& link, const Vec2& n) { return link.tangential_force * Vec2{{-n[1], n[0]}}; }
Vec3 tangential_force(const Link<3>& link, const Vec3&) { return link.tangential_force; }

// Cluster of a set, by its root; spans of all of them by the loops that its links close.
template <int D>
struct Joined {
  PlacedSets<D> sets;
  std::vector<std::array<bool, D>> spans;  // by body, true at any body of the cluster
};
template <int D>
Joined<D> join(const Packing<D>& packing, ForceMeasure measure, double threshold, std::vector<char>& stressed) {
  Joined<D> joined{PlacedSets<D>(packing.bodies.size()), {}};
  joined.spans.resize(packing.bodies.size());
  stressed.assign(packing.links.size(), 0);
  for (std::size_t l = 0; l < packing.links.size(); ++l) {
    const Link<D>& link = packing.links[l];
    if (!may_be_stressed(packing, link) || !(measured_force(link, measure) >= threshold)) continue;
    stressed[l] = 1;
    const auto winding = joined.sets.join(link.i, link.j, link.shift);
    for (std::size_t k = 0; winding && k < D; ++k) joined.spans[idx(link.i)][k] |= (*winding)[k] != 0;
  }
  return joined;
}

template <int D>
void add_link(StressedCluster<D>& c, const Packing<D>& packing, std::int32_t l) {
  const Link<D>& link = packing.links[idx(l)];
  const Vec<D> r = ends(packing, link).branch;
  const double distance = norm(r);
  const Vec<D> n = r / distance, force = link.normal_force * n + tangential_force(link, n);
  for (int a = 0; a < D; ++a) c.moment[static_cast<std::size_t>(a)] += force[a] * r;
  c.virial.add(link.normal_force, distance);
  c.links.push_back(l);
}

void add_places(StressedClusters<2>& all, const Packing<2>& packing) {
  for (StressedCluster<2>& c : all.clusters) {
    if (c.any_span()) continue;
    const auto places = link_places(packing, c.links);
    if (!places) continue;
    c.has_places = true;
    for (std::size_t k = 0; k < c.links.size(); ++k) {
      const Link<2>& link = packing.links[idx(c.links[k])];
      all.place[idx(c.links[k])] = (*places)[k];
      c.at[static_cast<std::size_t>((*places)[k])].add(link.normal_force, norm(ends(packing, link).branch));
    }
  }
}
void add_places(StressedClusters<3>&, const Packing<3>&) {}

double compensation(double unbalanced, double magnitude) {
  return magnitude > 0 ? 1 - unbalanced / magnitude : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

template <int D>
double measured_force(const Link<D>& link, ForceMeasure measure) {
  return measure == ForceMeasure::normal ? std::abs(link.normal_force) : force_magnitude(link);
}

template <int D>
StressedClusters<D> stressed_clusters(const Packing<D>& packing, ForceMeasure measure, double threshold) {
  std::vector<char> stressed;
  Joined<D> joined = join(packing, measure, threshold, stressed);
  std::map<std::int32_t, StressedCluster<D>> by_root;
  for (std::size_t l = 0; l < packing.links.size(); ++l)
    if (stressed[l])
      add_link(by_root[joined.sets.find(packing.links[l].i).root], packing, static_cast<std::int32_t>(l));
  for (std::size_t b = 0; b < packing.bodies.size(); ++b) {
    const auto found = by_root.find(joined.sets.find(static_cast<std::int32_t>(b)).root);
    if (found == by_root.end()) continue;
    StressedCluster<D>& c = found->second;
    c.grains.push_back(static_cast<std::int32_t>(b));
    c.measure += measure_of(packing.bodies.position[b], packing.bodies.radius[b]);
    for (std::size_t k = 0; k < D; ++k) c.spans[k] = c.spans[k] || joined.spans[b][k];
  }
  StressedClusters<D> all;
  for (auto& [root, cluster] : by_root) all.clusters.push_back(std::move(cluster));
  std::sort(all.clusters.begin(), all.clusters.end(), [](const auto& a, const auto& b) {
    if (a.grains.size() != b.grains.size()) return a.grains.size() > b.grains.size();
    return a.links.size() != b.links.size() ? a.links.size() > b.links.size() : a.grains[0] < b.grains[0];
  });
  all.of_link.assign(packing.links.size(), -1), all.of_body.assign(packing.bodies.size(), -1);
  all.place.assign(packing.links.size(), LinkPlace::inside);
  for (std::size_t c = 0; c < all.clusters.size(); ++c) {
    for (const std::int32_t l : all.clusters[c].links) all.of_link[idx(l)] = static_cast<std::int32_t>(c);
    for (const std::int32_t b : all.clusters[c].grains) all.of_body[idx(b)] = static_cast<std::int32_t>(c);
  }
  add_places(all, packing);
  return all;
}

template <int D>
ClusterCounts count_clusters_above(const Packing<D>& packing, ForceMeasure measure, double threshold) {
  std::vector<char> stressed;
  Joined<D> joined = join(packing, measure, threshold, stressed);
  std::map<std::int32_t, std::pair<std::int64_t, bool>> size;  // grains and whether it spans, by root
  ClusterCounts counts;
  counts.threshold = threshold;
  for (const char s : stressed) counts.links += s;
  for (std::size_t b = 0; b < packing.bodies.size(); ++b) {
    auto& [grains, spans] = size[joined.sets.find(static_cast<std::int32_t>(b)).root];
    ++grains;
    for (const bool s : joined.spans[b]) spans = spans || s;
  }
  double sum = 0, squares = 0;
  for (const auto& [root, what] : size) {
    const auto& [grains, spans] = what;
    if (grains == 1 && !spans) continue;  // in no cluster, but for a grain in touch with its own image
    ++counts.clusters, counts.spanning += spans;
    counts.largest = std::max(counts.largest, grains);
    sum += static_cast<double>(grains), squares += static_cast<double>(grains) * static_cast<double>(grains);
  }
  counts.mean_size = sum / static_cast<double>(counts.clusters);
  counts.mean_size_weighted = squares / sum;
  return counts;
}

template <int D>
Shuffled shuffled_compensation(const Packing<D>& packing, const StressedClusters<D>& stressed) {
  constexpr int kShuffles = 200;
  std::vector<double> virial;
  std::vector<std::size_t> size;
  for (const StressedCluster<D>& c : stressed.clusters) {
    if (c.any_span()) continue;
    size.push_back(c.links.size());
    for (const std::int32_t l : c.links) {
      const Link<D>& link = packing.links[idx(l)];
      virial.push_back(link.normal_force * norm(ends(packing, link).branch));
    }
  }
  double magnitude = 0, mean = 0, squares = 0;
  for (const double v : virial) magnitude += std::abs(v);
  std::mt19937_64 engine(20070111);
  std::vector<double> found;
  for (int n = 0; n < kShuffles; ++n) {
    for (std::size_t k = virial.size(); k > 1; --k) std::swap(virial[k - 1], virial[engine() % k]);
    double unbalanced = 0;
    std::size_t at = 0;
    for (const std::size_t links : size) {
      double sum = 0;
      for (std::size_t k = 0; k < links; ++k) sum += virial[at++];
      unbalanced += std::abs(sum);
    }
    found.push_back(compensation(unbalanced, magnitude));
    mean += found.back() / kShuffles;
  }
  for (const double f : found) squares += (f - mean) * (f - mean);
  return {mean, std::sqrt(squares / (kShuffles - 1))};
}

template double measured_force(const Link<2>&, ForceMeasure);
template double measured_force(const Link<3>&, ForceMeasure);
template StressedClusters<2> stressed_clusters(const Packing<2>&, ForceMeasure, double);
template StressedClusters<3> stressed_clusters(const Packing<3>&, ForceMeasure, double);
template ClusterCounts count_clusters_above(const Packing<2>&, ForceMeasure, double);
template ClusterCounts count_clusters_above(const Packing<3>&, ForceMeasure, double);
template Shuffled shuffled_compensation(const Packing<2>&, const StressedClusters<2>&);
template Shuffled shuffled_compensation(const Packing<3>&, const StressedClusters<3>&);

}  // namespace isostat
