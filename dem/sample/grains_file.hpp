// What grains.file says about grains that a run of round bodies starts with: their cell, and how heavy they are.
#pragma once
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "dem/files/packing_file.hpp"

namespace isostat {

// With the edges of grains.box (empty: none) for a file without a cell, of any format. Throws InputError as
// read_packing() does.
PackingFile read_grains_file(const std::string& path, const std::vector<double>& box);

// Masses that say more than radii do. `counts(k)`: body k is to be looked at.
template <int D, class Counts>
bool densities_differ(const Bodies<D>& b, Counts counts) {
  constexpr double kRounding = 1e-9;
  double least = INFINITY, most = 0;
  for (std::size_t k = 0; k < b.size(); ++k) {
    if (!(b.radius[k] > 0) || !counts(k)) continue;
    const double density = b.mass[k] / std::pow(b.radius[k], D);
    least = std::min(least, density), most = std::max(most, density);
  }
  return most > (1 + kRounding) * least;
}

}  // namespace isostat
