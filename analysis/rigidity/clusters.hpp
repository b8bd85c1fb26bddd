// Decomposition of a packing into maximal rigid clusters, exact: two neighbours belong together when they move as one
// rigid body in a random vector of null G over a prime field, which (up to a chance of 1e-12) means in all of them.
//
// With friction a cluster is a set of grains, and pins between clusters are hinges. Frictionless grains are points: a
// cluster is a set of links, and a grain may be the hinge of several. Grains of triangles have an orientation: clusters
// are sets of triangles, the grains they belong to are counted, and what is one grain alone is no cluster. Walls are
// one rigid body: what stands still with them is one cluster. Frictionless spheres: two links at a grain belong
// together if they turn alike, and a link on which two clusters hinge counts in both.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "analysis/input.hpp"
#include "analysis/sphere_network.hpp"
#include "dem/state/packing.hpp"

namespace isostat {

struct RigidCluster {
  std::int64_t grains = 0;       // at least 2, or 1 that stands still with the walls, which are no grains
  std::int64_t links = 0;        // inside the cluster
  std::int64_t rows = 0;         // of G, of those links
  std::int64_t hyperstatic = 0;  // H of the cluster by itself
  std::array<bool, 3> spans{};   // connected to its own image along axis 1, 2, 3
};

struct RigidClusters {
  std::vector<RigidCluster> clusters;            // by decreasing number of grains
  std::vector<std::int32_t> cluster_of_link;     // by link of the network, the largest; -1: it joins different clusters
  std::vector<std::vector<std::int32_t>> links;  // by cluster, ascending
  std::vector<std::int32_t> cluster_of_grain;    // by body: the largest that holds it; -1: in none
};

// Throws InputError if cell_free is asked for without a cell.
RigidClusters rigid_clusters(const LinkNetwork& network, NetworkLaw law, bool cell_free);
RigidClusters rigid_clusters(const SphereNetwork& network, NetworkLaw law, bool cell_free);

}  // namespace isostat
