// Contacts of a packing by touching: every pair of grains (any image, also a grain and its own image) whose gap is at
// most a tolerance.
#pragma once
#include <vector>

#include "dem/state/packing.hpp"

namespace isostat {

// Closed links with their gap, forces zero; sorted by (i, j, shift), i <= j. Not between bodies of walls. gap_tolerance
// [length], >= 0.
template <int D>
std::vector<Link<D>> touching_links(const Packing<D>& packing, double gap_tolerance);

// The contacts of a packing made anew by touching. Its beams stay, first in the list; what a beam joins, through the
// same image, is one piece and does not touch.
template <int D>
void find_contacts(Packing<D>& packing, double gap_tolerance);

// Default tolerance: 1e-9 of the largest radius, far above rounding and far below any physical overlap.
inline constexpr double kTouchingTolerance = 1e-9;
template <int D>
double default_gap_tolerance(const Bodies<D>& bodies);

}  // namespace isostat
