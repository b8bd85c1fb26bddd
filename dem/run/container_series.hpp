// The columns of the time series that tell what the grains do in a hopper or in a drum, for every system.
#pragma once
#include <cstddef>
#include <vector>

#include "dem/run/series.hpp"
#include "dem/scene/surroundings.hpp"
#include "dem/state/container_motion.hpp"
#include "dem/state/state.hpp"
#include "geometry/vec.hpp"

namespace isostat {

// The free grains, where they are seen from the container's origin: the slices of a vibrated hopper go with it.
struct Contents {
  std::vector<Vec2> position;  // of the centres of mass
  std::vector<double> mass, area;
  std::size_t above = 0;  // that are not below the outlet
};

// Hopper: what has left, and the solid fraction of 16 equal slices of its height, from the outlet up. Drum: its angle
// and the inclination of the bed, in degrees. Other shapes have none.
void add_container_columns(std::vector<SeriesColumn>& columns, const ContainerScene& container,
                           const Surroundings& surroundings, const ContainerPlacement& placement,
                           const Contents& contents);

}  // namespace isostat
