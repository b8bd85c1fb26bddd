// Rules that tie scene keys of triangles together (dem/scene/check.hpp).
#pragma once
#include <vector>

#include "dem/scene/check.hpp"

namespace isostat {

std::vector<SceneConflict> triangle_conflicts(const Scene& scene);

}  // namespace isostat
