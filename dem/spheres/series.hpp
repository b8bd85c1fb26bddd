// What the time series of spheres says of an instant.
#pragma once
#include <vector>

#include "dem/run/series.hpp"
#include "dem/spheres/spheres.hpp"

namespace isostat {

// What needs a cell is left out of an isolated packing's. Spheres keep no energy ledger.
std::vector<SeriesColumn> series_columns(const State<Spheres>& state, bool energies);

}  // namespace isostat
