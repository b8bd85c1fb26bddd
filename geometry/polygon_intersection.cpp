#include "geometry/polygon_intersection.hpp"

#include <CGAL/Boolean_set_operations_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_2.h>
#include <CGAL/Polygon_with_holes_2.h>

#include <cmath>
#include <iterator>
#include <stdexcept>

namespace isostat {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Polygon = CGAL::Polygon_2<Kernel>;
using PolygonWithHoles = CGAL::Polygon_with_holes_2<Kernel>;

Polygon anticlockwise(std::span<const Vec2> corners) {
  Polygon p;
  for (const Vec2& c : corners) {
    if (!std::isfinite(c[0]) || !std::isfinite(c[1]))
      throw std::invalid_argument("polygon_intersection: a coordinate is not finite");
    p.push_back({c[0], c[1]});
  }
  if (p.size() < 3 || !p.is_simple() || p.orientation() == CGAL::COLLINEAR)
    throw std::invalid_argument("polygon_intersection: a polygon of " + std::to_string(p.size()) +
                                " corners is not simple");
  if (p.orientation() == CGAL::CLOCKWISE) p.reverse_orientation();
  return p;
}

double rounded(const Kernel::FT& x) {
  x.exact();  // narrows the interval that to_double looks at to the rounding of the exact number
  return CGAL::to_double(x);
}

}  // namespace

PolygonIntersection polygon_intersection(std::span<const Vec2> a, std::span<const Vec2> b) {
  std::vector<PolygonWithHoles> parts;
  CGAL::intersection(anticlockwise(a), anticlockwise(b), std::back_inserter(parts));
  PolygonIntersection out;
  Kernel::FT area = 0;
  for (const PolygonWithHoles& part : parts) {
    const Polygon& outer = part.outer_boundary();
    area += outer.area();
    std::vector<Vec2>& corners = out.parts.emplace_back();
    for (const auto& c : outer.vertices()) corners.push_back({rounded(c.x()), rounded(c.y())});
  }
  out.area = rounded(area);
  return out;
}

}  // namespace isostat
