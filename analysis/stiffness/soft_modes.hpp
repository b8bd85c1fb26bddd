// Smallest nonzero singular values of G: how far the integer K is from being larger.
#pragma once
#include <vector>

#include "analysis/input.hpp"
#include "analysis/sphere_network.hpp"

namespace isostat {

// Dimensionless: spins are measured as R_i w_i, moments rows by the mean radius, those of
// overlaps by their largest force, strains by the cell's edges (so that
// units and sizes don't matter). Ascending, at most `count`. Throws std::length_error if there are too many null
// vectors to project out.
std::vector<double> smallest_singular_values(const LinkNetwork& network, NetworkLaw law, bool cell_free, int count);
std::vector<double> smallest_singular_values(const SphereNetwork& network, NetworkLaw law, bool cell_free, int count);

}  // namespace isostat
