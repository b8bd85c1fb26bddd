// Work dealt out to threads along the lists, with sums in the order of the list: engines share these.
#pragma once
#include <vector>

#include "dem/solver/neighbours.hpp"
#include "dem/solver/team.hpp"

namespace isostat {

// tallies[c] = work(first body, end) for every chunk of bodies.
template <class Columns, class Tally, class Work>
void over_chunks(Team& team, const NeighbourLists<Columns>& lists, std::vector<Tally>& tallies, Work&& work) {
  tallies.resize(static_cast<std::size_t>(lists.chunks()));
  team.run(lists.chunks(), [&](int chunk) {
    tallies[static_cast<std::size_t>(chunk)] = work(lists.chunk_begin(chunk), lists.chunk_begin(chunk + 1));
  });
}

// Sum of work(group) over all groups, phase by phase: groups of one phase touch disjoint bodies.
template <class Columns, class Tally, class Work>
Tally over_groups(Team& team, const NeighbourLists<Columns>& lists, std::vector<Tally>& tallies, Work&& work) {
  Tally sum{};
  for (int phase = 0; phase < NeighbourLists<Columns>::kPhases; ++phase) {
    const std::vector<PairGroup>& groups = lists.phase(phase);
    tallies.assign(groups.size(), {});
    team.run(static_cast<int>(groups.size()),
             [&](int g) { tallies[static_cast<std::size_t>(g)] += work(groups[static_cast<std::size_t>(g)]); });
    for (const Tally& t : tallies) sum += t;
  }
  return sum;
}

}  // namespace isostat
