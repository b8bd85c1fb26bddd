// Quadrature points on the walls of a union of disks, for integrals of exp(-ik.r) along them.
#pragma once
#include <span>
#include <vector>

#include "geometry/periodic_cell.hpp"

namespace isostat {

// The walls as points with the outward normal times their length.
struct WallPoints {
  std::vector<Vec2> at;
  std::vector<double> normal_x, normal_y;  // [length]
  double covered_area = 0;                 // [length^2]
};

// Good to `tolerance` of the length of a wall up to k_max [1/length].
WallPoints wall_points(std::span<const Vec2> centre, std::span<const double> radius, const PeriodicCell<2>& cell,
                       double k_max, double tolerance);

}  // namespace isostat
