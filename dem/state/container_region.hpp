// The room inside a container, as it is built: where grains may be placed, for every system.
#pragma once
#include "dem/scene/surroundings.hpp"
#include "geometry/vec.hpp"

namespace isostat {

double slope_height(const ContainerScene& container);  // of a hopper's slopes; 0 of other shapes
double region_bottom(const ContainerScene& container);
double region_top(const ContainerScene& container);  // of the upright walls or of the drum
double half_width(const ContainerScene& container);

// A circle that touches no wall (nor the closed outlet) and does not stand out at the top.
bool holds(const ContainerScene& container, const Vec2& centre, double radius);

// Area of the room below the height y.
double area_below(const ContainerScene& container, double y);
// The height below which the room has this area; the top if there is less.
double height_of_area(const ContainerScene& container, double area);

}  // namespace isostat
