// What lies in each slice of height: density waves in a hopper are read from it, time after time.
#pragma once
#include <span>
#include <vector>

#include "geometry/vec.hpp"

namespace isostat {

// Sum of the weights (masses, areas) of the points whose height is in each of `slices` equal slices from low to high,
// over the thickness of a slice; points beyond the ends count nowhere.
std::vector<double> density_profile(std::span<const Vec2> position, std::span<const double> weight, double low,
                                    double high, std::size_t slices);

}  // namespace isostat
