#include "dem/state/clusters.hpp"

#include "geometry/union_find.hpp"

namespace isostat {

std::size_t count_clusters(const Packing<2>& p) {
  UnionFind joined(p.bodies.size());
  std::size_t count = p.bodies.size();
  for (const Link<2>& l : p.links) count -= joined.join(static_cast<std::size_t>(l.i), static_cast<std::size_t>(l.j));
  return count;
}

}  // namespace isostat
