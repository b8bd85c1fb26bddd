// Colours of rigid clusters, for grains of any system: strong where the cluster is hyperstatic, pale where it is not.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "analysis/figure/legend.hpp"

namespace isostat {

// One colour a cluster, an index into kCurves: in order of the clusters, the first that no neighbour has; the first
// cluster keeps the first colour. meet: pairs of clusters that are neighbours; a negative one is none.
std::vector<std::size_t> cluster_colors(std::size_t clusters, const std::vector<std::array<std::int32_t, 2>>& meet);

// Fills of grains: the first is of those in no cluster, the others are strong and pale of each colour.
std::vector<Color> cluster_fills();
inline std::size_t cluster_fill(std::size_t color, bool hyperstatic) { return 1 + 2 * color + (hyperstatic ? 0 : 1); }

// of_body: cluster, or -1; hyperstatic: one a cluster.
std::vector<LegendItem> cluster_legend(double em, const std::vector<std::int32_t>& of_body,
                                       const std::vector<bool>& hyperstatic);

}  // namespace isostat
