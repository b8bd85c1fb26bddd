// What stands around spheres in a picture: the edges of the periodic cell, planes and shells. What is behind the
// spheres is drawn before them, what is in front of them after them.
#pragma once
#include <array>

#include "analysis/figure/sphere_pen.hpp"

namespace isostat {

enum class Side { back, front };

// An edge is at the back where both faces that meet in it look away from the viewer.
void draw_cell(Canvas& canvas, const SpherePen& pen, Side side);
// A plane is at the back where its grains are on the viewer's side of it; a shell is an outline behind its grains.
void draw_walls(Canvas& canvas, const SpherePen& pen, Side side);

// Corners, counted from middle_of(), of the part of a plane that its grains stand over.
std::array<Vec3, 4> patch_of(const SpherePacking& packing, const SphereWall& plane);

}  // namespace isostat
