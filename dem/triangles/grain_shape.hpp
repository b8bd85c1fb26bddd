// Shapes of grains by name, or from a file of corners, as triangles. Lengths in cm.
//
//   square     side S: four triangles about the centre, as in Poeschel and Buchholtz 1995, Sec. 6.1
//   triangle   one equilateral triangle of side S, without beams
//   polygonN   regular, N sides of length S (3 to 64): N triangles about the centre; polygon4 is the square
//   rod        length S, width S/4: four squares in a row, each halved by a diagonal, in a zigzag
//   L          arms of length S and width S/2: three squares, each like `square`
//   star       five tips on a circle of diameter S: a pentagon of five triangles, and one more on each side
#pragma once
#include <cstddef>
#include <optional>
#include <string>

#include "geometry/triangle_mesh.hpp"

namespace isostat {

inline constexpr double kGrainSize = 0.14;            // [cm] S where none is given
inline constexpr std::size_t kMostCorners = 2000;     // of a file: finding crossing sides takes the square of it
inline constexpr std::size_t kMostTriangles = 10000;  // of a refined polygon

// The shape of this name with S = size, or else the polygon of a file: one corner "x y" a line [cm], in either
// orientation, '#' begins a comment; size is then a factor (1 where none is given), and with refine > 0 [cm] the
// polygon is cut until no edge is longer. Throws InputError: unknown name, unreadable file, a line that is no corner, a
// polygon that is not simple or has no area, a refinement of a named shape.
TriangleMesh grain_shape(const std::string& name_or_file, std::optional<double> size = std::nullopt, double refine = 0);

}  // namespace isostat
