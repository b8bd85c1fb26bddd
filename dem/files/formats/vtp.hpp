// VTK PolyData for ParaView: grains as vertices, links as lines (docs/formats.md).
#pragma once
#include <string>

#include "dem/state/packing.hpp"

namespace isostat {

// XML with raw appended data (little endian, 64-bit headers). Points: the grains (inside the cell), then for each link
// that leaves the cell the image of j it reaches (image = 1), so that lines have their true length and direction.
// Point data: id, radius, mass, velocity, spin, image. Cell data (vertices, then links): kind (-1 for a vertex, else
// 0 c, 1 s, 2 r, 3 sr, 4 d), gap, N, T, M (3D: vectors T, M), F. `time` [T0] as field data.
template <int D>
std::string vtk_polydata(const Packing<D>& packing, double time);

}  // namespace isostat
