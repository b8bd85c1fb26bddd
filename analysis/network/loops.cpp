#include "analysis/network/loops.hpp"

#include <algorithm>

#include "geometry/base/index.hpp"

namespace isostat {
namespace {

struct Way {
  std::int32_t to, link;
};

}  // namespace

// Tarjan's bridges, without recursion: a link down the tree of a depth-first search is a bridge if nothing below it
// reaches back above it. Parallel links and links to an own image are told apart by their numbers.
template <int D>
LoopCount count_loops(const Packing<D>& packing) {
  const std::size_t bodies = packing.bodies.size();
  const auto wall = static_cast<std::int32_t>(bodies);  // one node for all that is held
  const auto node = [&](std::int32_t body) { return is_free(packing.part, idx(body)) ? body : wall; };
  std::vector<std::vector<Way>> from(bodies + 1);
  for (std::size_t l = 0; l < packing.links.size(); ++l) {
    const std::int32_t i = node(packing.links[l].i), j = node(packing.links[l].j);
    from[idx(i)].push_back({j, static_cast<std::int32_t>(l)});
    if (i != j) from[idx(j)].push_back({i, static_cast<std::int32_t>(l)});
  }
  LoopCount count;
  count.on_loop.assign(packing.links.size(), 1);
  constexpr std::int32_t kUnseen = -1;
  std::vector<std::int32_t> entered(bodies + 1, kUnseen), lowest(bodies + 1, 0), by(bodies + 1, -1);
  std::vector<std::size_t> next(bodies + 1, 0);
  std::int32_t clock = 0;
  std::int64_t nodes = 0;
  for (std::size_t root = 0; root <= bodies; ++root) {
    const bool stands_for_itself = root == bodies ? count_free(packing) < bodies : is_free(packing.part, root);
    if (entered[root] != kUnseen || !stands_for_itself) continue;
    ++count.components;
    std::vector<std::size_t> stack{root};
    entered[root] = lowest[root] = clock++;
    while (!stack.empty()) {
      const std::size_t v = stack.back();
      if (next[v] < from[v].size()) {
        const Way way = from[v][next[v]++];
        if (way.link == by[v]) continue;
        const std::size_t w = idx(way.to);
        if (entered[w] == kUnseen) {
          entered[w] = lowest[w] = clock++, by[w] = way.link;
          stack.push_back(w);
        } else {
          lowest[v] = std::min(lowest[v], entered[w]);
        }
        continue;
      }
      stack.pop_back(), ++nodes;
      if (stack.empty()) continue;
      const std::size_t up = stack.back();
      if (lowest[v] > entered[up]) count.on_loop[idx(by[v])] = 0;
      lowest[up] = std::min(lowest[up], lowest[v]);
    }
  }
  count.independent = std::ssize(packing.links) - nodes + count.components;
  return count;
}

template LoopCount count_loops(const Packing<2>&);
template LoopCount count_loops(const Packing<3>&);

}  // namespace isostat
