// Two states of the same grains: which grain of the one is which of the other, and how far each has gone.
#pragma once
#include <cstdint>
#include <vector>

#include "dem/state/packing.hpp"

namespace isostat {

// Grains (walls and their feet are none) that both packings have, by id, in the order of the second.
struct Matching {
  std::vector<std::size_t> before, after;  // indices of bodies
  std::vector<std::int32_t> of_before;     // place in the two above of each body of the first packing, or -1
  std::vector<std::int32_t> of_after;
  std::size_t size() const { return after.size(); }
};

template <int D>
Matching match_grains(const Packing<D>& before, const Packing<D>& after);

// The cell after, told by the one of its equivalent tilts that is nearest to the tilt before.
template <int D>
PeriodicCell<D> followed(const PeriodicCell<D>& before, PeriodicCell<D> after);

// Displacement of each matched grain beyond the affine motion of the cell [a]: the change of its position in fractions
// of the cell, nearest image, times the edges of the cell after, less the mean of all. Without a cell: the change of
// position less the mean. Right as long as no grain has gone half a cell against the others.
template <int D>
std::vector<Vec<D>> nonaffine_displacements(const Packing<D>& before, const Packing<D>& after, const Matching& grains);

}  // namespace isostat
