// What the time series of disks says of an instant.
#pragma once
#include <vector>

#include "dem/disks/disks.hpp"
#include "dem/run/series.hpp"

namespace isostat {

// What needs a cell is left out of an isolated packing's.
std::vector<SeriesColumn> series_columns(const State<Disks>& state, bool energies);

}  // namespace isostat
