// Rank of G over the rationals by plain elimination on exact fractions. Independent of analysis/rigidity: the rows are
// written out here from Gilabert 2007, Eq. A2 with proportional lever arms, scaled by |r_ij|;
// a beam has all three, about the middle of its length. Walls stand still, wherever they are in the list.
#pragma once
#include "analysis/input.hpp"
#include "dem/state/packing.hpp"
#include "dem/triangles/triangles.hpp"
#include "geometry/triangle_signs.hpp"

namespace isostat {

std::int64_t rational_rank(const Packing<2>& packing, NetworkLaw law, bool cell_free);

// The same for spheres: the velocity at the contact point of a contact with friction, the normal one of other links,
// the relative angular velocity where rolling is resisted.
std::int64_t rational_rank(const Packing<3>& packing, NetworkLaw law, bool cell_free);

// The same for grains of triangles, none held: overlaps are looked for among all pairs and images, and a pair of grains
// has one row for all of them. With friction it has a second one, at the mean of the pairs' points weighted by areas;
// the point of a pair is the mean of its sides weighted by the parts of their edges that they are.
std::int64_t rational_rank(const TrianglePacking& packing, const std::vector<Triangle>& triangles, NetworkLaw law,
                           bool cell_free);

}  // namespace isostat
