#include "dem/clusters.hpp"

#include <numeric>
#include <vector>

namespace isostat {

std::size_t count_clusters(const Packing<2>& p) {
  std::vector<std::size_t> parent(p.bodies.size());
  std::iota(parent.begin(), parent.end(), 0);
  auto root = [&](std::size_t k) {
    while (parent[k] != k) k = parent[k] = parent[parent[k]];
    return k;
  };
  std::size_t count = p.bodies.size();
  for (const Link<2>& l : p.links) {
    const std::size_t a = root(static_cast<std::size_t>(l.i)), b = root(static_cast<std::size_t>(l.j));
    if (a != b) parent[a] = b, --count;
  }
  return count;
}

}  // namespace isostat
