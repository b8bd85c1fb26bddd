// Random networks of spheres on a jittered cubic lattice with bonds along edges, face and space diagonals: any
// coordination up to 26, several images of a pair and own images in small cells. Coordinates have short mantissas, so
// that exact fractions stay small.
#pragma once
#include <array>
#include <cstdint>

#include "dem/state/packing.hpp"

namespace isostat {

struct RandomSpheres {
  std::array<int, 3> size{3, 3, 3};
  double coordination = 6;
  bool periodic = true;
  double jitter = 0.3;  // of the lattice constant 1; 0: special positions
  double tilt = 0;      // of the second edge along the first; bonds across it are as long as they become
  bool equal_radii = false;
  double distant = 0, sliding = 0, rolling_yielded = 0, both_yielded = 0;  // fractions of the links
  std::uint64_t seed = 1;
};
Packing<3> random_spheres(const RandomSpheres& options);

// n^3 copies of a periodic packing side by side in one cell; every link is copied.
Packing<3> replicated(const Packing<3>& packing, int n);

}  // namespace isostat
