// Which triangles of different grains overlap, with exact signs; and what connected overlaps of grains they make. For
// readers of files, snapshots and analysis: the step loop has lists and a kernel of its own.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "dem/triangles/triangles.hpp"
#include "geometry/triangle_signs.hpp"

namespace isostat {

// Every triangle in the plane, by corners_of().
std::vector<Triangle> placed_triangles(const TrianglePacking& packing);
// The triangle as an image of itself.
Triangle image_of(const Triangle& t, const std::optional<PeriodicCell<2>>& cell, const ImageShift<2>& shift);

// Two triangles with common area, of two grains or of one grain and its own image.
struct TriangleTouch {
  std::int32_t i = 0, j = 0;  // triangles; grain of i <= grain of j
  ImageShift<2> shift{};      // of j
  friend bool operator==(const TriangleTouch&, const TriangleTouch&) = default;
};
// Sorted by grains, shift, triangles. Pairs of what is held (walls, lids) are left out. Exact: types of
// geometry/triangle_signs.hpp, corners of j as rounded by image_of().
std::vector<TriangleTouch> touching_triangles(const TrianglePacking& packing, std::span<const Triangle> triangles);

// Do two triangles share an edge? In a deformed grain they gape: an edge of one lies along one of the other, in the
// opposite sense, when both ends are nearer than half the shortest edge of the two.
bool share_an_edge(const Triangle& a, const Triangle& b);

struct ConnectedOverlap {
  std::int32_t grain_i = 0, grain_j = 0;
  ImageShift<2> shift{};           // of grain j
  std::size_t begin = 0, end = 0;  // its pairs
};
struct ConnectedOverlaps {
  std::vector<TriangleTouch> touch;       // in the order of the overlaps
  std::vector<ConnectedOverlap> overlap;  // by grains and shift; of two grains, by their first pairs
  std::span<const TriangleTouch> of(const ConnectedOverlap& o) const {
    return std::span(touch).subspan(o.begin, o.end - o.begin);
  }
};
// Connected by neighbourhood, never by touching polygons: two pairs belong together if they share a triangle, or
// triangles that are joined by a beam or share an edge, in both grains. (In a deformed bed 40 % of the overlaps of
// several pieces are disconnected as polygons.)
ConnectedOverlaps connected_overlaps(const TrianglePacking& packing, std::span<const Triangle> triangles);

}  // namespace isostat
