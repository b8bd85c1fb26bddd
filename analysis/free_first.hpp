// Bodies of a packing in another order: those that are free first, walls and lids last.
#pragma once
#include <algorithm>
#include <utility>
#include <vector>

#include "dem/state/packing.hpp"
#include "geometry/base/index.hpp"

namespace isostat {

template <class T>
void in_order(std::vector<T>& values, const std::vector<std::int32_t>& order) {
  std::vector<T> sorted;
  sorted.reserve(values.size());
  for (const std::int32_t k : order) sorted.push_back(values[idx(k)]);
  values = std::move(sorted);
}

template <int D>
void put_free_bodies_first(Packing<D>& p) {
  if (p.part.empty()) return;
  std::vector<std::int32_t> order(p.bodies.size()), place(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = static_cast<std::int32_t>(k);
  std::stable_partition(order.begin(), order.end(), [&](std::int32_t k) { return is_free(p.part, idx(k)); });
  for (std::size_t k = 0; k < order.size(); ++k) place[idx(order[k])] = static_cast<std::int32_t>(k);
  Bodies<D>& b = p.bodies;
  in_order(b.id, order), in_order(b.position, order), in_order(b.velocity, order), in_order(b.spin, order);
  in_order(b.radius, order), in_order(b.mass, order), in_order(b.inertia, order), in_order(p.part, order);
  for (Link<D>& l : p.links) l.i = place[idx(l.i)], l.j = place[idx(l.j)];
}

}  // namespace isostat
