// Walls of a union of disks by brute force: every circle against every image of every other, angular intervals sorted,
// arcs chained where one circle dives under another. No triangulation, no shared code; O(n^2).
#pragma once
#include <vector>

#include "tests/support/disk_packings.hpp"

namespace isostat::oracle {

struct WallLoop {
  double length = 0;       // [length]
  double signed_area = 0;  // [length^2] of the disks' side: positive for an island's outer wall, negative for a pore's
  std::array<int, 2> winding{};  // cells that the loop advances by
};
// General position is assumed (no tangencies, no three circles through one point).
std::vector<WallLoop> wall_loops(const Disks& disks);

struct WallArc {
  Vec2 centre{};
  double radius = 0, start = 0, sweep = 0;  // anticlockwise from `start` [rad]
};
std::vector<WallArc> wall_arcs(const Disks& disks);

}  // namespace isostat::oracle
