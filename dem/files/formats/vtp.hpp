// VTK PolyData for ParaView: grains as vertices, links as lines (docs/formats.md).
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "dem/state/packing.hpp"

namespace isostat {

// What a system knows beside its packing.
template <int D>
struct VtkExtras {
  std::vector<std::int32_t> group;  // of the bodies: point data `group`; empty: none
  struct Foot {
    Link<D> link;  // of body i alone
    Vec<D> reach;  // from its centre to the wall
  };
  std::vector<Foot> feet;  // contacts with walls: lines to further points with image = 2, after the links
};

// XML with inline base64 data (dem/files/formats/vtk_arrays.hpp). Points: the grains (inside the cell), then for each
// link that leaves the cell the image of j it reaches (image = 1), so that lines have their true length and direction.
// Point data: id, radius, mass, velocity, spin, image. Cell data (vertices, then links): kind (-1 for a vertex, else
// 0 c, 1 s, 2 r, 3 sr, 4 d), gap, N, T, M (3D: vectors T, M), F. `time` [T0] as field data.
template <int D>
std::string vtk_polydata(const Packing<D>& packing, double time, const VtkExtras<D>& extras = {});

}  // namespace isostat
