// Rank of G over the rationals by plain elimination on exact fractions. Independent of analysis/rigidity: the rows are
// written out here from Gilabert 2007, Eq. A2 with proportional lever arms, scaled by |r_ij|;
// a beam has all three, about the middle of its length. Walls stand still, wherever they are in the list.
#pragma once
#include "analysis/input.hpp"
#include "dem/state/packing.hpp"

namespace isostat {

std::int64_t rational_rank(const Packing<2>& packing, NetworkLaw law, bool cell_free);

}  // namespace isostat
