#include "analysis/compare/link_changes.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "dem/state/link_ends.hpp"
#include "geometry/base/index.hpp"

namespace isostat {
namespace {

using Pair = std::pair<std::int32_t, std::int32_t>;  // matched grains, the smaller first

// Wanted links in storage order.
template <int D>
struct PairLink {
  Pair pair;
  std::size_t link;
  Vec<D> branch;  // from the first of the pair to the second; of a grain and its own image, upwards
};

template <int D>
std::vector<PairLink<D>> pair_links(const Packing<D>& packing, const std::vector<std::int32_t>& matched,
                                    LinkFamily family) {
  std::vector<PairLink<D>> found;
  for (std::size_t l = 0; l < packing.links.size(); ++l) {
    const Link<D>& link = packing.links[l];
    const bool wanted = family == LinkFamily::contacts ? is_contact(link.kind) : link.kind == LinkKind::distant;
    const std::int32_t i = matched[idx(link.i)], j = matched[idx(link.j)];
    if (!wanted || i < 0 || j < 0) continue;
    const Vec<D> r = ends(packing, link).branch;
    const bool forwards = i != j ? i < j : r.c > Vec<D>{}.c;
    found.push_back({std::minmax(i, j), l, forwards ? r : -1.0 * r});
  }
  return found;
}

}  // namespace

template <int D>
LinkChanges link_changes(const Packing<D>& before, const Packing<D>& after, const Matching& grains, LinkFamily family) {
  LinkChanges changes;
  const std::vector<PairLink<D>> later = pair_links(after, grains.of_after, family);
  std::map<Pair, std::vector<const PairLink<D>*>> candidates;
  for (const PairLink<D>& one : later) candidates[one.pair].push_back(&one);
  std::vector<bool> kept(after.links.size());
  for (const PairLink<D>& one : pair_links(before, grains.of_before, family)) {
    std::vector<const PairLink<D>*>& of_pair = candidates[one.pair];
    const auto nearest = std::min_element(of_pair.begin(), of_pair.end(), [&](const auto* a, const auto* b) {
      return norm(a->branch - one.branch) < norm(b->branch - one.branch);
    });
    if (nearest == of_pair.end()) {
      changes.lost.push_back(one.link);
      continue;
    }
    changes.kept_before.push_back(one.link);
    changes.kept_after.push_back((*nearest)->link);
    kept[(*nearest)->link] = true;
    of_pair.erase(nearest);
  }
  for (const PairLink<D>& one : later)
    if (!kept[one.link]) changes.gained.push_back(one.link);
  return changes;
}

template LinkChanges link_changes(const Packing<2>&, const Packing<2>&, const Matching&, LinkFamily);
template LinkChanges link_changes(const Packing<3>&, const Packing<3>&, const Matching&, LinkFamily);

}  // namespace isostat
