// A packing in a tilted cell described anew.
#pragma once
#include "dem/state/packing.hpp"

namespace isostat {

// The cell in its shape nearest to a rectangle: as it would be lowered to when it shears.
template <int D>
void lower_tilt(Packing<D>& packing) {
  if (!packing.cell) return;
  const int turns = packing.cell->turns();
  packing.cell->tilt -= turns * packing.cell->length[0];
  for (Link<D>& l : packing.links) l.shift[0] += turns * l.shift[1];
}

}  // namespace isostat
