// The only file that sees CGAL's constrained triangulations.
#include "geometry/polygon_triangulation.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_size_criteria_2.h>
#include <CGAL/Delaunay_mesh_vertex_base_2.h>
#include <CGAL/Delaunay_mesher_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <vector>

#include "geometry/base/index.hpp"

namespace isostat {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Structure = CGAL::Triangulation_data_structure_2<CGAL::Delaunay_mesh_vertex_base_2<Kernel>,
                                                       CGAL::Delaunay_mesh_face_base_2<Kernel>>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure>;
using Criteria = CGAL::Delaunay_mesh_size_criteria_2<Triangulation>;
using Point = Kernel::Point_2;

// |B| in CGAL: the bound on the squared sine of the smallest angle for which refinement ends (Shewchuk 2000).
constexpr double kShapeBound = 0.125;

Point point(const Vec2& p) { return {p[0], p[1]}; }

std::optional<PolygonFault> repeated(std::span<const Vec2> corners) {
  std::vector<std::size_t> order(corners.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return std::pair(corners[a].c, a) < std::pair(corners[b].c, b); });
  for (std::size_t k = 0; k + 1 < order.size(); ++k)
    if (corners[order[k]] == corners[order[k + 1]])
      return PolygonFault{PolygonFault::Kind::repeated_corner, order[k], order[k + 1]};
  return std::nullopt;
}

// Do the edges that begin at corners i < j meet elsewhere than in a corner they share?
bool edges_meet(std::span<const Vec2> corners, std::size_t i, std::size_t j) {
  const std::size_t n = corners.size();
  const auto at = [&](std::size_t k) { return point(corners[k % n]); };
  const auto folds_back = [](const Point& a, const Point& b, const Point& c) {  // from a to b and back towards a
    return CGAL::collinear(a, b, c) && !CGAL::collinear_are_ordered_along_line(a, b, c);
  };
  if (j == i + 1) return folds_back(at(i), at(j), at(j + 1));
  if (i == 0 && j == n - 1) return folds_back(at(j), at(0), at(1));
  return CGAL::do_intersect(Kernel::Segment_2(at(i), at(i + 1)), Kernel::Segment_2(at(j), at(j + 1)));
}

}  // namespace

std::string describe(const PolygonFault& fault) {
  const std::string a = std::to_string(fault.first + 1), b = std::to_string(fault.second + 1);
  switch (fault.kind) {
    case PolygonFault::Kind::too_few_corners:
      return "a polygon has at least three corners";
    case PolygonFault::Kind::not_finite:
      return "corner " + a + " is not a finite point";
    case PolygonFault::Kind::repeated_corner:
      return "corners " + a + " and " + b + " are the same point (the last side closes the polygon by itself)";
    case PolygonFault::Kind::no_area:
      return "all corners lie on one line: the polygon has no area";
    case PolygonFault::Kind::self_intersecting:
      return "the polygon intersects itself: the sides that begin at corners " + a + " and " + b + " meet";
  }
  return {};
}

std::optional<PolygonFault> polygon_fault(std::span<const Vec2> corners) {
  using Kind = PolygonFault::Kind;
  const std::size_t n = corners.size();
  if (n < 3) return PolygonFault{Kind::too_few_corners};
  for (std::size_t i = 0; i < n; ++i)
    if (!std::isfinite(corners[i][0]) || !std::isfinite(corners[i][1])) return PolygonFault{Kind::not_finite, i};
  if (const auto fault = repeated(corners)) return fault;
  bool line = true;
  for (std::size_t i = 2; i < n && line; ++i)
    line = CGAL::collinear(point(corners[0]), point(corners[1]), point(corners[i]));
  if (line) return PolygonFault{Kind::no_area};
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j)
      if (edges_meet(corners, i, j)) return PolygonFault{Kind::self_intersecting, i, j};
  return std::nullopt;
}

TriangleMesh triangulate_polygon(std::span<const Vec2> corners, double size) {
  if (const auto fault = polygon_fault(corners)) throw PolygonError(*fault);
  Triangulation cut;
  std::vector<Triangulation::Vertex_handle> vertices;
  for (const Vec2& p : corners) vertices.push_back(cut.insert(point(p)));
  for (std::size_t i = 0; i < vertices.size(); ++i)
    cut.insert_constraint(vertices[i], vertices[(i + 1) % vertices.size()]);
  CGAL::Delaunay_mesher_2<Triangulation, Criteria> mesher(cut, Criteria(kShapeBound, size));
  mesher.mark_facets();  // inside or outside
  if (size > 0) mesher.refine_mesh();

  TriangleMesh mesh;
  std::map<Triangulation::Vertex_handle, std::int32_t> number;
  const auto add = [&](Triangulation::Vertex_handle v) {
    if (number.emplace(v, static_cast<std::int32_t>(mesh.points.size())).second)
      mesh.points.push_back({{v->point().x(), v->point().y()}});
  };
  for (const auto& v : vertices) add(v);
  for (const auto& v : cut.finite_vertex_handles()) add(v);
  for (const auto& f : cut.finite_face_handles())
    if (f->is_in_domain()) mesh.triangles.push_back({number[f->vertex(0)], number[f->vertex(1)], number[f->vertex(2)]});
  return mesh;
}

}  // namespace isostat
