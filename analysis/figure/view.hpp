// The direction from which a packing in space is seen: orthographic, so that lengths across it are true.
#pragma once
#include "geometry/vec.hpp"

namespace isostat {

struct View {
  Vec3 right, up, toward;  // unit vectors on the page and toward the viewer, right-handed

  Vec2 flat(const Vec3& r) const { return {{dot(right, r), dot(up, r)}}; }
  double depth(const Vec3& r) const { return dot(toward, r); }  // larger is nearer
};

// The viewer stands in the direction of that longitude, from x to y, and latitude, -90 to 90 [degrees]; z leads up.
View view_from(double azimuth, double elevation);

// Along an axis: from +x with y to the right, from -y with x to the right, from +z with x to the right and y up.
View view_along(int axis);

}  // namespace isostat
