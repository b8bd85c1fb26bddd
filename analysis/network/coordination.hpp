// Which interactions count, which grains are rattlers, and the coordination numbers (Gilabert 2007, Sec. III.A, Eq.
// 13).
//
// With cohesion every contact and distant pair counts and no grain is removed. Without, only contacts above
// 1e-4 F1 count, and rattlers are removed recursively: a grain left with fewer than two counted contacts cannot balance
// a force. Without any force in the input every link counts and the rattlers are the grains without link. Beams are no
// interactions of surfaces: they count nowhere, but a grain that a beam holds is never a rattler. Walls and lids are no
// grains: contacts with them count, but they are never rattlers.
#pragma once
#include <cstdint>
#include <vector>

#include "analysis/network/force_scale.hpp"

namespace isostat {

struct Coordination {
  std::vector<char> counted;               // per link: an interaction
  std::vector<char> rattler;               // per body
  std::vector<char> held;                  // per body: by a beam, or a wall
  std::vector<int> degree;                 // per body: counted interactions (an own image counts at both ends)
  std::vector<int> backbone_degree;        // per body: those with non-rattlers only; 0 for rattlers
  std::int64_t contacts = 0, distant = 0;  // counted ones, by kind
  std::int64_t unloaded = 0;               // contacts that do not count
  std::int64_t with_walls = 0;             // counted ones between a grain and a wall
  std::int64_t beams = 0;
  std::int64_t rattlers = 0;
  std::int64_t backbone_links = 0;  // counted interactions between non-rattlers
};

// Mean number of interactions of the grains, and of those left without rattlers (Eq. 13); not a number without any.
template <int D>
double mean_degree(const Packing<D>& packing, const Coordination& coordination);
template <int D>
double mean_backbone_degree(const Packing<D>& packing, const Coordination& coordination);

template <int D>
Coordination coordination(const Packing<D>& packing, const ForceReading& reading);

}  // namespace isostat
