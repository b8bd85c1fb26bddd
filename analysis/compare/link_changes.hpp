// What became of the links between two states of the same grains.
#pragma once
#include <cstdint>
#include <vector>

#include "analysis/compare/matching.hpp"

namespace isostat {

// Links of one kind (contacts, or distant pairs) between matched grains. Of several links of a pair (images in a small
// cell) those whose branch vectors are nearest are the same.
struct LinkChanges {
  std::vector<std::size_t> lost;                     // indices of links before
  std::vector<std::size_t> gained;                   // indices of links after
  std::vector<std::size_t> kept_before, kept_after;  // pairwise the same link
};

enum class LinkFamily { contacts, distant };

template <int D>
LinkChanges link_changes(const Packing<D>& before, const Packing<D>& after, const Matching& grains, LinkFamily family);

}  // namespace isostat
