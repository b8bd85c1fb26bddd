#include "analysis/network/link_places.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "dem/state/link_ends.hpp"
#include "geometry/base/index.hpp"

namespace isostat {
namespace {

// A link seen from one of its ends: 2 k from i, 2 k + 1 from j.
struct HalfEdge {
  std::size_t grain;  // it leaves, by its place in the cluster
  Vec2 way;
  std::size_t next = 0;  // around the face on its left
};

std::vector<HalfEdge> half_edges(const Packing<2>& packing, const std::vector<std::int32_t>& links,
                                 std::size_t& grains) {
  std::unordered_map<std::int32_t, std::size_t> place;
  const auto of = [&](std::int32_t body) { return place.try_emplace(body, place.size()).first->second; };
  std::vector<HalfEdge> all;
  for (const std::int32_t l : links) {
    const Link<2>& link = packing.links[idx(l)];
    const Vec2 r = ends(packing, link).branch;
    all.push_back({of(link.i), r}), all.push_back({of(link.j), -1.0 * r});
  }
  grains = place.size();
  std::vector<std::vector<std::size_t>> leaving(grains);
  for (std::size_t h = 0; h < all.size(); ++h) leaving[all[h].grain].push_back(h);
  for (auto& fan : leaving) {
    const auto angle = [&](std::size_t h) { return std::atan2(all[h].way[1], all[h].way[0]); };
    std::sort(fan.begin(), fan.end(),
              [&](std::size_t a, std::size_t b) { return angle(a) != angle(b) ? angle(a) < angle(b) : a < b; });
    // Who arrives against fan[k] leaves by the one clockwise of it, the sharpest turn to the left.
    for (std::size_t k = 0; k < fan.size(); ++k) all[fan[k] ^ 1].next = fan[(k + fan.size() - 1) % fan.size()];
  }
  return all;
}

}  // namespace

std::optional<std::vector<LinkPlace>> link_places(const Packing<2>& packing, const std::vector<std::int32_t>& links) {
  std::size_t grains = 0;
  const std::vector<HalfEdge> edge = half_edges(packing, links, grains);
  constexpr auto kNone = static_cast<std::size_t>(-1);
  std::vector<std::size_t> face(edge.size(), kNone);
  std::size_t faces = 0, outer = 0;
  double least = 0;
  for (std::size_t first = 0; first < edge.size(); ++first) {
    if (face[first] != kNone) continue;
    Vec2 at{};
    double twice_area = 0;
    for (std::size_t h = first; face[h] == kNone; h = edge[h].next) {
      face[h] = faces;
      twice_area += at[0] * edge[h].way[1] - at[1] * edge[h].way[0];
      at += edge[h].way;
    }
    if (faces == 0 || twice_area < least) outer = faces, least = twice_area;  // it alone is seen from outside
    ++faces;
  }
  if (grains + faces != links.size() + 2) return std::nullopt;
  std::vector<LinkPlace> places;
  for (std::size_t k = 0; k < links.size(); ++k) {
    const std::size_t left = face[2 * k], right = face[2 * k + 1];
    places.push_back(left == right                     ? LinkPlace::bridge
                     : left == outer || right == outer ? LinkPlace::rim
                                                       : LinkPlace::inside);
  }
  return places;
}

}  // namespace isostat
