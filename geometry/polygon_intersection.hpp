// Intersection of two simple polygons, exact: the slow, general path beside triangle_overlap.hpp, for shapes of any
// number of corners and as the oracle of tests.
#pragma once
#include <span>
#include <vector>

#include "geometry/vec.hpp"

namespace isostat {

struct PolygonIntersection {
  double area = 0;                       // the exact area, rounded: relative error below 1e-15
  std::vector<std::vector<Vec2>> parts;  // anticlockwise, rounded corners; parts that meet in points only are apart
};

// Corners in either orientation, finite. What both polygons have inside, points and segments left out. There are no
// holes: each point outside one of the polygons is joined to infinity outside it.
// Throws std::invalid_argument unless each polygon is simple: at least three corners, edges meeting only at the corner
// that they share. Rational arithmetic of CGAL: some 30 us for two triangles, O(n log n) in the number of corners.
PolygonIntersection polygon_intersection(std::span<const Vec2> a, std::span<const Vec2> b);

}  // namespace isostat
