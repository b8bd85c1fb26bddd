// Random sequential placement of grains without overlap: their real shapes are tested, not circles around them.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "dem/triangles/grain_template.hpp"
#include "geometry/cell_grid.hpp"

namespace isostat {

using TriangleCorners = std::array<Vec2, 3>;  // anticlockwise

// The triangles of a grain with its centroid at `centre`, turned by `angle`.
std::vector<TriangleCorners> placed(const GrainTemplate& grain, const Vec2& centre, double angle);

// Some line along an edge of one of them leaves a gap of this width at least between the two. Exact for gap = 0.
bool apart(const TriangleCorners& a, const TriangleCorners& b, double gap);

// Triangles that lie still, found by their bounding boxes in a grid. With a cell they lie in all its images.
class TriangleField {
 public:
  // box: where triangles will be looked for; width: of most of them; number: of these about.
  TriangleField(const Frame<2>& box, const std::optional<PeriodicCell<2>>& cell, double width, std::size_t number);

  void add(const TriangleCorners& triangle);
  // None of them is nearer to one of these than the gap.
  bool leaves_room(const std::vector<TriangleCorners>& triangles, double gap) const;

 private:
  struct Columns {
    std::array<int, 2> low, high;
  };
  Columns columns(const TriangleCorners& triangle) const;
  void add_one(const TriangleCorners& triangle);

  std::optional<PeriodicCell<2>> cell_;
  CellGrid<2> grid_;
  std::vector<TriangleCorners> triangles_;
  std::vector<std::vector<std::int32_t>> members_;
};

}  // namespace isostat
