#include "apps/draw/sphere_clusters.hpp"

#include "analysis/figure/cluster_colors.hpp"
#include "analysis/rigidity/clusters.hpp"
#include "geometry/base/index.hpp"

namespace isostat {

std::unique_ptr<SphereContent> sphere_clusters(const AnalysisInput& input) {
  const SphereNetwork network = input.spheres();
  const RigidClusters rigid = rigid_clusters(network, input.network_law({}), false);
  std::vector<std::array<std::int32_t, 2>> meet;
  for (std::size_t l = 0; l < network.links(); ++l)
    network.each_bond(l, [&](std::int32_t i, std::int32_t j, const ImageShift<3>&) {
      const std::int32_t a = rigid.cluster_of_grain[idx(i)], b = rigid.cluster_of_grain[idx(j)];
      meet.insert(meet.end(), {{a, b}, {a, rigid.cluster_of_link[l]}, {b, rigid.cluster_of_link[l]}});
    });
  const std::vector<std::size_t> color = cluster_colors(rigid.clusters.size(), meet);

  std::vector<BallStyle> styles;
  for (const Color& fill : cluster_fills()) styles.push_back({fill, {}});
  std::vector<std::size_t> style;
  for (const std::int32_t c : rigid.cluster_of_grain) {
    const bool hyperstatic = c >= 0 && rigid.clusters[idx(c)].hyperstatic > 0;
    style.push_back(c < 0 ? 0 : cluster_fill(color[idx(c)], hyperstatic));
    BallStyle& legend = styles[c < 0 ? 0 : cluster_fill(0, hyperstatic)];  // the first colour stands for all
    legend.label = plain(c < 0 ? "single" : hyperstatic ? "hyperstatic cluster" : "isostatic cluster");
  }
  return balls_content(std::move(style), std::move(styles));
}

}  // namespace isostat
