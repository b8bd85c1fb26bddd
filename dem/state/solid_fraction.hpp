// Solid fraction: volume (in the plane, area) of the bodies over that of the cell; overlaps are not subtracted.
#pragma once
#include <limits>
#include <numbers>
#include <optional>

#include "dem/state/packing.hpp"

namespace isostat {

// Not a number without a cell.
template <int D>
double solid_fraction(const Bodies<D>& bodies, const std::optional<PeriodicCell<D>>& cell) {
  if (!cell) return std::numeric_limits<double>::quiet_NaN();
  double sum = 0;
  for (const double r : bodies.radius)
    sum += D == 2 ? std::numbers::pi * r * r : 4.0 / 3.0 * std::numbers::pi * r * r * r;
  return sum / cell->measure();
}

template <int D>
double solid_fraction(const Packing<D>& packing, const std::optional<PeriodicCell<D>>& cell) {
  return solid_fraction(packing.bodies, cell);
}
// Of a packing in its own cell; each system's packing has the form with a cell.
template <class Packing>
double solid_fraction(const Packing& packing) {
  return solid_fraction(packing, packing.cell);
}

}  // namespace isostat
