#include "analysis/network/coordination.hpp"

#include <cstddef>

#include "geometry/base/index.hpp"

namespace isostat {
namespace {

// Links of each body, by index, in compressed rows; a link to an own image appears twice.
struct Incidence {
  std::vector<std::size_t> start, link;
};

template <int D>
Incidence incidence(const Packing<D>& packing, const std::vector<char>& counted) {
  Incidence inc;
  inc.start.assign(packing.bodies.size() + 1, 0);
  for (std::size_t l = 0; l < packing.links.size(); ++l)
    if (counted[l]) ++inc.start[idx(packing.links[l].i) + 1], ++inc.start[idx(packing.links[l].j) + 1];
  for (std::size_t k = 0; k + 1 < inc.start.size(); ++k) inc.start[k + 1] += inc.start[k];
  inc.link.resize(inc.start.back());
  std::vector<std::size_t> next(inc.start.begin(), inc.start.end() - 1);
  for (std::size_t l = 0; l < packing.links.size(); ++l)
    if (counted[l])
      for (const std::int32_t end : {packing.links[l].i, packing.links[l].j}) inc.link[next[idx(end)]++] = l;
  return inc;
}

// Removes bodies with fewer than `least` remaining interactions until none is left to remove.
template <int D>
void remove_rattlers(const Packing<D>& packing, Coordination& c, int least, bool recursive) {
  const Incidence inc = incidence(packing, c.counted);
  std::vector<std::int32_t> leaving;
  c.backbone_degree = c.degree;
  for (std::size_t k = 0; k < c.degree.size(); ++k)
    if (c.degree[k] < least && !c.held[k]) c.rattler[k] = 1, leaving.push_back(static_cast<std::int32_t>(k));
  std::vector<char> cut(packing.links.size(), 0);
  while (!leaving.empty()) {
    const std::int32_t k = leaving.back();
    leaving.pop_back();
    ++c.rattlers;
    for (std::size_t e = inc.start[idx(k)]; e < inc.start[idx(k) + 1]; ++e) {
      const std::size_t l = inc.link[e];
      if (cut[l]) continue;
      cut[l] = 1;
      for (const std::int32_t end : {packing.links[l].i, packing.links[l].j}) {
        --c.backbone_degree[idx(end)];
        if (recursive && !c.rattler[idx(end)] && !c.held[idx(end)] && c.backbone_degree[idx(end)] < least)
          c.rattler[idx(end)] = 1, leaving.push_back(end);
      }
    }
  }
}

}  // namespace

template <int D>
Coordination coordination(const Packing<D>& packing, const ForceReading& reading) {
  Coordination c;
  const bool loaded_only = reading.known && !reading.cohesive;
  c.counted.resize(packing.links.size());
  c.degree.assign(packing.bodies.size(), 0);
  c.rattler.assign(packing.bodies.size(), 0);
  c.held.assign(packing.bodies.size(), 0);
  for (std::size_t k = 0; k < c.held.size(); ++k) c.held[k] = !is_free(packing.part, k);
  for (std::size_t l = 0; l < packing.links.size(); ++l) {
    const Link<D>& link = packing.links[l];
    if (link.kind == LinkKind::beam) {
      ++c.beams;
      c.held[idx(link.i)] = c.held[idx(link.j)] = 1;
      continue;
    }
    c.counted[l] = !loaded_only || (is_contact(link.kind) && force_magnitude(link) > reading.threshold);
    if (!c.counted[l]) {
      c.unloaded += is_contact(link.kind);
      continue;
    }
    ++(is_contact(link.kind) ? c.contacts : c.distant);
    ++c.degree[idx(link.i)], ++c.degree[idx(link.j)];
    c.with_walls += !is_free(packing.part, idx(link.i)) || !is_free(packing.part, idx(link.j));
  }
  if (loaded_only)
    remove_rattlers(packing, c, 2, true);
  else if (!reading.known)
    remove_rattlers(packing, c, 1, false);
  else
    c.backbone_degree = c.degree;
  for (std::size_t l = 0; l < packing.links.size(); ++l)
    c.backbone_links += c.counted[l] && !c.rattler[idx(packing.links[l].i)] && !c.rattler[idx(packing.links[l].j)];
  return c;
}

template <int D>
double mean_degree(const Packing<D>& packing, const Coordination& c) {
  std::int64_t sum = 0;
  for (std::size_t k = 0; k < c.degree.size(); ++k)
    if (is_free(packing.part, k)) sum += c.degree[k];
  return static_cast<double>(sum) / static_cast<double>(count_free(packing));
}

template <int D>
double mean_backbone_degree(const Packing<D>& packing, const Coordination& c) {
  std::int64_t sum = 0;
  for (std::size_t k = 0; k < c.degree.size(); ++k)
    if (is_free(packing.part, k) && !c.rattler[k]) sum += c.backbone_degree[k];
  return static_cast<double>(sum) / static_cast<double>(static_cast<std::int64_t>(count_free(packing)) - c.rattlers);
}

template Coordination coordination(const Packing<2>&, const ForceReading&);
template Coordination coordination(const Packing<3>&, const ForceReading&);
template double mean_degree(const Packing<2>&, const Coordination&);
template double mean_degree(const Packing<3>&, const Coordination&);
template double mean_backbone_degree(const Packing<2>&, const Coordination&);
template double mean_backbone_degree(const Packing<3>&, const Coordination&);

}  // namespace isostat
