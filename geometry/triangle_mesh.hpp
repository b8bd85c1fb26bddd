// Triangles that share corners: plain arrays, and which of them meet along an edge.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "geometry/vec.hpp"

namespace isostat {

struct TriangleMesh {
  std::vector<Vec2> points;
  std::vector<std::array<std::int32_t, 3>> triangles;  // corners anticlockwise: indices into points
};

// Pairs of triangles, first < second, that have an edge (two corners) in common; ascending.
std::vector<std::array<std::int32_t, 2>> edge_neighbours(const TriangleMesh& mesh);

// Twice the signed area: positive if a, b, c turn anticlockwise. Differences first, so that the rounding is relative to
// the triangle and not to its distance from the origin.
inline double doubled_area(const Vec2& a, const Vec2& b, const Vec2& c) {
  const Vec2 u = b - a, v = c - a;
  return u[0] * v[1] - u[1] * v[0];
}

}  // namespace isostat
