// How two triangles lie to each other, from signs alone: the 18 orientations of a corner of one against an edge of the
// other, exact. Types of overlap after Poeschel and Buchholtz, J. Phys. I 5, 1431 (1995), sec. 3, Figs. 3-7.
#pragma once
#include <array>
#include <cstdint>
#include <string_view>

#include "geometry/vec.hpp"

namespace isostat {

// Corners in either orientation. Edge k goes from corner k to corner k + 1 (mod 3). Any unit of length.
struct Triangle {
  std::array<Vec2, 3> corner;
};

enum class OverlapType : std::uint8_t {
  separate,    // no common point
  touch,       // common points, no common area (always so with a triangle of no area)
  degenerate,  // common area, and a corner on the line of an edge of the other, or one triangle inside the other
  i,           // two crossings of edges, both on one edge of one of the triangles
  ii,          // two, on different edges of both
  iii,         // four, two each on two edges of both
  iv,          // four, one of the triangles is crossed on all its edges
  v            // six
};
std::string_view name(OverlapType type);

// The pair with both triangles anticlockwise, and where the corners lie.
struct TriangleSigns {
  Triangle a, b;
  bool a_turned = false, b_turned = false;         // corners 1 and 2 have changed places
  std::array<std::array<std::int8_t, 3>, 3> of_a;  // [corner of A][edge of B]: 1 inside, 0 on the line, -1 outside
  std::array<std::array<std::int8_t, 3>, 3> of_b;  // [corner of B][edge of A]
  OverlapType type = OverlapType::separate;

  // Edge e of A crosses edge f of B in the interior of both (meaningful where no sign is 0).
  bool cross(int e, int f) const;
  static constexpr int next(int k) { return k == 2 ? 0 : k + 1; }
};
// Signs are filled in where the type is not separate.
TriangleSigns triangle_signs(const Triangle& a, const Triangle& b);

// Exact for all finite coordinates, also of triangles without area.
OverlapType overlap_type(const Triangle& a, const Triangle& b);

}  // namespace isostat
