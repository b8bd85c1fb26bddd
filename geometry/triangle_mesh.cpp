#include "geometry/triangle_mesh.hpp"

#include <algorithm>

#include "geometry/base/index.hpp"

namespace isostat {

std::vector<std::array<std::int32_t, 2>> edge_neighbours(const TriangleMesh& mesh) {
  struct Edge {
    std::int32_t low, high, triangle;
    bool operator<(const Edge& e) const {
      return std::array{low, high, triangle} < std::array{e.low, e.high, e.triangle};
    }
  };
  std::vector<Edge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]);
      edges.push_back({low, high, static_cast<std::int32_t>(t)});
    }
  std::sort(edges.begin(), edges.end());
  std::vector<std::array<std::int32_t, 2>> pairs;
  for (std::size_t e = 0; e + 1 < edges.size(); ++e)
    if (edges[e].low == edges[e + 1].low && edges[e].high == edges[e + 1].high)
      pairs.push_back({edges[e].triangle, edges[e + 1].triangle});
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace isostat
