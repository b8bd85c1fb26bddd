// The union of disks as a signed sum of disks and of weighted points, for transforms up to a wave number: the disks
// less the lenses of pairs, which are small regions and enter as quadrature points.
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "geometry/periodic_cell.hpp"

namespace isostat {

struct UnionTerms {
  std::vector<double> disk_weight;   // per disk: 1, but for deep lenses
  std::vector<Vec2> point;           // [length]
  std::vector<double> point_weight;  // [length^2]
};

// Nothing where three disks may have a point in common, or one lies inside another. Relative to the disks' area the
// points are good to `tolerance` up to k_max [1/length].
std::optional<UnionTerms> union_terms(std::span<const Vec2> centre, std::span<const double> radius,
                                      const PeriodicCell<2>& cell, double k_max, double tolerance);

}  // namespace isostat
