// What the time series of grains of triangles says of an instant.
#pragma once
#include <vector>

#include "dem/run/series.hpp"
#include "dem/triangles/triangles.hpp"

namespace isostat {

// Columns of a cell, of a container, of beams that fail and of energies stand where the scene has them.
std::vector<SeriesColumn> series_columns(const State<TriangleGrains>& state, bool energies);

}  // namespace isostat
