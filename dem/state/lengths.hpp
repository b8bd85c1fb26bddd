// Which lengths a packing may have. Everything that reads packings asks here: beyond these bounds squares overflow, or
// grids and lists grow with the empty space rather than with the grains; mostly it is a mistake of units.
#pragma once
#include <optional>
#include <string>

#include "dem/state/packing.hpp"

namespace isostat {

inline constexpr double kSmallestCell =
    0.1;  // [largest radius] edge of a cell: below, grains meet dozens of own images
inline constexpr double kLargestExtent = 1e6;   // [largest radius] edge of a cell, or of the box of an isolated packing
inline constexpr double kMostTilt = 100;        // [L1]
inline constexpr double kSmallestGrain = 1e-6;  // [largest radius]
inline constexpr double kLeastRadius = 1e-60, kMostRadius = 1e60;  // [length of the file] of the largest grain
inline constexpr double kLargestGapTolerance = 10;                 // [largest radius]

// Throws InputError naming file, edge (with the line that gives the cell) or grain, value and rule. Bodies of radius 0
// (feet on walls) have no say.
template <int D>
void require_lengths(const std::optional<PeriodicCell<D>>& cell, const Bodies<D>& bodies, const std::string& path,
                     std::optional<double> gap_tolerance = std::nullopt, int cell_line = 0);

}  // namespace isostat
