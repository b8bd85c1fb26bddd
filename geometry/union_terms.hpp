// The union of disks as a signed sum of disks and of weighted points, for transforms up to a wave number.
//
// Inclusion and exclusion over the dual complex: indicator of the union = sum over its vertices of the disks, less the
// lenses of its edges, plus the common parts of its faces (Edelsbrunner 1995, Thm. 4.1). Lenses and triple parts are
// small regions and enter as quadrature points.
#pragma once
#include <span>
#include <vector>

#include "geometry/periodic_cell.hpp"

namespace isostat {

struct UnionTerms {
  std::vector<double> disk_weight;   // per disk: mostly 1; 0 if it is covered by others
  std::vector<Vec2> point;           // [length]
  std::vector<double> point_weight;  // [length^2]
};

// Relative to the disks' area the points are good to `tolerance` up to k_max [1/length].
UnionTerms union_terms(std::span<const Vec2> centre, std::span<const double> radius, const PeriodicCell<2>& cell,
                       double k_max, double tolerance);

}  // namespace isostat
