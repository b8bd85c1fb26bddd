// Extended XYZ (OVITO, ASE): grains only (docs/formats.md).
#pragma once
#include <string>

#include "dem/state/packing.hpp"

namespace isostat {

// One frame: number of grains; Lattice, pbc, Properties and Time; rows species id x y z radius vx vy vz wx wy wz mass.
// `time` [T0].
template <int D>
std::string extended_xyz(const Packing<D>& packing, double time);

}  // namespace isostat
