// VTK PolyData of triangles for ParaView (docs/formats.md).
#pragma once
#include <string>

#include "dem/triangles/triangles.hpp"

namespace isostat {

// [g/s^2] of each grain: mean normal stress of the overlaps' forces, compression positive; beams and weight are left
// out.
std::vector<double> overlap_pressures(const TrianglePacking& packing);

// XML with raw appended data (little endian, 64-bit headers). A polygon for each triangle, its three corners as points,
// with its grain inside the cell as a whole. Cell data: id, grain (its id), part (0 free, 1 wall, 2 lid), pressure of
// the grain, velocity and spin of the triangle. `time` [s] as field data.
std::string vtk_polydata(const TrianglePacking& packing, double time);

}  // namespace isostat
