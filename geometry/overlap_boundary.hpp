// Which edges bound the overlap of two triangles, and where they meet: from exact signs alone. The first half of
// triangle_overlap.hpp; corners and areas are computed there.
#pragma once
#include <array>
#include <cstdint>

#include "geometry/triangle_signs.hpp"

namespace isostat {

enum class Owner : std::uint8_t { a, b };
enum class CornerKind : std::uint8_t { corner_a, corner_b, crossing };

// A corner of the overlap: corner a of A, corner b of B, or the crossing of edges a and b.
struct OverlapCorner {
  CornerKind kind;
  int a, b;
  friend bool operator==(const OverlapCorner&, const OverlapCorner&) = default;
};
struct OverlapEdge {
  Owner owner;
  int edge;
  OverlapCorner start;
};
struct OverlapBoundary {
  std::array<OverlapEdge, 6> side;
  int count = 0;
};

// Anticlockwise around the overlap of a pair with common area; the first edge starts where the lowest edge of A enters
// B, if edges cross. Sides of no length are left out; one that lies on edges of both is A's.
OverlapBoundary overlap_boundary(const TriangleSigns& signs);

}  // namespace isostat
