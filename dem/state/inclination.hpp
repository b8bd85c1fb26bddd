// How steep the free surface of grains in a drum is, read in two ways.
#pragma once
#include <limits>
#include <span>

#include "geometry/vec.hpp"

namespace isostat {

struct Inclination {
  // [rad] positive where the surface rises to the right, i.e. in a drum that turns anticlockwise; not a number where
  // there is nothing to be read from.
  double surface = std::numeric_limits<double>::quiet_NaN();
  double centre_of_mass = std::numeric_limits<double>::quiet_NaN();
};

inline constexpr int kSurfaceColumns = 12;
inline constexpr double kSurfacePart = 0.7;  // [-] of the half width, about the middle, that the surface is read from

// surface: of the line of least squares through the highest grain in each of 12 columns about the middle. centre of
// mass: of its direction from the middle against straight down, which a half-filled drum has at a right angle to its
// surface; far more robust.
Inclination inclination(std::span<const Vec2> position, std::span<const double> mass, const Vec2& middle,
                        double half_width);

}  // namespace isostat
