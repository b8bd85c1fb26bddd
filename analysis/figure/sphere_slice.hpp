// A plane section through a packing of spheres, as a packing of disks: the exact circles in which the plane cuts them.
#pragma once
#include <cstddef>
#include <string_view>
#include <vector>

#include "analysis/figure/view.hpp"
#include "dem/spheres/spheres.hpp"

namespace isostat {

// The plane across an axis; on the page it lies as view_along(axis) shows it.
struct Slice {
  int axis = 2;
  double at = 0;  // [length]
};

struct SlicedSpheres {
  Packing<2> packing;  // circles, and links both of whose spheres are cut; N, and |T| without its direction
  std::vector<std::size_t> sphere;  // of each circle: a body; one that is larger than the cell may be cut twice
};

// Every image of a sphere that the plane cuts makes a circle. A sphere that the plane touches in a point is not cut.
// Across the first axis a cell must not lean (std::invalid_argument): the section would not be periodic.
SlicedSpheres cut(const SpherePacking& packing, const Slice& slice);

}  // namespace isostat
