// A simple polygon, convex or not, cut into triangles: constrained Delaunay, every edge of the polygon kept.
#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>

#include "geometry/triangle_mesh.hpp"

namespace isostat {

struct PolygonFault {
  enum class Kind { too_few_corners, not_finite, repeated_corner, no_area, self_intersecting };
  Kind kind;
  std::size_t first = 0, second = 0;  // corners from 0: the two equal ones, or where the two edges that meet begin
};
// One sentence; corners are counted from 1.
std::string describe(const PolygonFault& fault);

// What keeps these corners, in either orientation, from bounding a simple polygon with an area; decided by exact
// predicates. Edges may meet at their common corner only: touching another edge, or folding back, is self-intersection.
// A corner in the middle of a straight side is allowed. Quadratic in the number of corners.
std::optional<PolygonFault> polygon_fault(std::span<const Vec2> corners);

class PolygonError : public std::invalid_argument {
 public:
  explicit PolygonError(const PolygonFault& f) : std::invalid_argument(describe(f)), fault(f) {}
  PolygonFault fault;
};

// The triangles fill the polygon and do not overlap. Without a size the corners are the only points and come first, in
// their order; with one, points are added until no edge is longer than size (0: no limit) and, but for sharp corners of
// the polygon, no angle below 20.7 degrees (Shewchuk 2000), which moves the sides by a rounding. Throws PolygonError.
TriangleMesh triangulate_polygon(std::span<const Vec2> corners, double size = 0);

}  // namespace isostat
