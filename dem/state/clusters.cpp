#include "dem/state/clusters.hpp"

#include "geometry/union_find.hpp"

namespace isostat {

template <int D>
std::size_t count_clusters(const Packing<D>& p) {
  UnionFind joined(p.bodies.size());
  std::size_t count = count_free(p);
  for (const Link<D>& l : p.links) {
    const auto i = static_cast<std::size_t>(l.i), j = static_cast<std::size_t>(l.j);
    if (is_free(p.part, i) && is_free(p.part, j)) count -= joined.join(i, j);
  }
  return count;
}

template std::size_t count_clusters(const Packing<2>&);
template std::size_t count_clusters(const Packing<3>&);

}  // namespace isostat
