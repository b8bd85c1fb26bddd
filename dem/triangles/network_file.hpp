// Plain-text networks of triangles (`.net`), lengths in cm:
//
//   cell L1 L2                          periodic cell; optional, at most once
//   triangle ID GRAIN X0 Y0 X1 Y1 X2 Y2 corners in either orientation, in the cell or outside; ID and GRAIN any
//   integers beam I J [S1 S2]                    elastic beam between the centroids of two triangles, without load as
//   it stands,
//                                       with the stiffnesses of beam_at_rest(); without S the nearest image of J
//
// Lines may come in any order. Triangles with one GRAIN are made contiguous, grains and triangles in the order of their
// lines. Overlaps are found. Corners of neighbours in a grain need not meet exactly: grains may be deformed.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "dem/triangles/triangles.hpp"
#include "geometry/triangle_signs.hpp"

namespace isostat {

struct TriangleNetworkFile {
  TrianglePacking packing;  // angles and velocities zero; one Overlap for each connected overlap; density 1 g/cm^2
  std::vector<Triangle> triangles;  // the corners of the file, anticlockwise, where corners_of() rounds
};

// Throws InputError listing the faults with file and line. box: the cell of a file that has none.
TriangleNetworkFile read_triangle_network(const std::string& path, const std::optional<Vec2>& box = std::nullopt);
TriangleNetworkFile parse_triangle_network(std::string_view text, const std::string& path,
                                           const std::optional<Vec2>& box = std::nullopt);

// With 17 significant digits. What the format has no column for is left behind: walls and lids, velocities, the beams'
// stiffnesses and their shape at rest. Throws InputError if only walls would be left.
std::string triangle_network_text(const TrianglePacking& packing, const std::vector<Triangle>& triangles);

}  // namespace isostat
