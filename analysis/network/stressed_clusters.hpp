// Clusters of stressed contacts (Gilabert 2007, Secs. IV.B.1 and IV.C): grains that links above a threshold of force
// join, and how tension and compression balance inside each.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "analysis/network/force_measure.hpp"
#include "dem/state/packing.hpp"

namespace isostat {

// Of links of a cluster: sums of N r and |N| r, r the distance of the centres [force length]. The first is the trace of
// the sum of F r over them (T does no work along r), and so D times the pressure times an area. Over the links of a
// cluster that nothing else loads it is 0: tension and compression balance.
struct Virial {
  std::int64_t links = 0;
  double sum = 0, magnitude = 0;
  void add(double normal_force, double distance) {
    ++links, sum += normal_force * distance, magnitude += std::abs(normal_force) * distance;
  }
  void add(const Virial& other) { links += other.links, sum += other.sum, magnitude += other.magnitude; }
};

// Where a link lies in its cluster, drawn in the plane: at the outer face on one side; between two inner faces; or with
// one face on both sides, so that cutting it cuts the cluster.
enum class LinkPlace : std::uint8_t { rim, inside, bridge };
inline constexpr std::size_t kLinkPlaces = 3;

template <int D>
struct StressedCluster {
  std::vector<std::int32_t> grains, links;  // ascending
  std::array<bool, D> spans{};              // it is connected to its own image along axis 1, 2(, 3)
  double measure = 0;                       // [length^D] area or volume of its grains
  std::array<Vec<D>, D> moment{};           // [force length] sum of F_a r_b over its links: measure times stress
  Virial virial;
  bool has_places = false;             // in the plane, not spanning, and drawn without crossings
  std::array<Virial, kLinkPlaces> at;  // by LinkPlace, where it has_places
  bool any_span() const { return std::find(spans.begin(), spans.end(), true) != spans.end(); }
  std::int64_t loops() const { return std::ssize(links) - std::ssize(grains) + 1; }  // independent
};

template <int D>
struct StressedClusters {
  std::vector<StressedCluster<D>> clusters;    // by decreasing number of grains, then of links, then by first grain
  std::vector<std::int32_t> of_link, of_body;  // cluster, or -1
  std::vector<LinkPlace> place;                // by link; of those of clusters that have places
};

// Contacts and distant pairs with a force >= threshold; links with walls or lids join nothing and count nowhere.
template <int D>
StressedClusters<D> stressed_clusters(const Packing<D>& packing, ForceMeasure measure, double threshold);

template <int D>
double measured_force(const Link<D>& link, ForceMeasure measure);

// How many clusters there are above each threshold, and how large.
struct ClusterCounts {
  double threshold = 0;
  std::int64_t links = 0, clusters = 0, largest = 0, spanning = 0;
  double mean_size = 0;           // NaN without clusters
  double mean_size_weighted = 0;  // of the cluster of a grain: sum n^2 / sum n
};
template <int D>
ClusterCounts count_clusters_above(const Packing<D>& packing, ForceMeasure measure, double threshold);

// What would be left of the balance if forces knew nothing of where they are: 1 - sum |sum N r| / sum |N| r over the
// clusters, mean and standard deviation with the N r of all their links shuffled among them (200 times, always alike).
struct Shuffled {
  double mean = 0, sd = 0;
};
template <int D>
Shuffled shuffled_compensation(const Packing<D>& packing, const StressedClusters<D>& stressed);

}  // namespace isostat
