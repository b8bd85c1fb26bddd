// Smooth walls around a packing of disks, as lines in its picture; a lid is dashed.
#pragma once
#include <vector>

#include "analysis/figure/picture_frame.hpp"
#include "analysis/figure/picture_pen.hpp"
#include "dem/state/smooth_walls.hpp"

namespace isostat {

// The window with room for the walls beside the grains; what leads far away from them is cut off.
Extent with_walls(Extent extent, const std::vector<SmoothWall>& walls);

void draw_walls(Canvas& canvas, const FramePen& pen, const std::vector<SmoothWall>& walls);

}  // namespace isostat
