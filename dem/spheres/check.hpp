// The rules between scene keys that are about spheres (dem/scene/check.hpp).
#pragma once
#include <vector>

#include "dem/scene/check.hpp"

namespace isostat {

std::vector<SceneConflict> sphere_conflicts(const Scene& scene);

}  // namespace isostat
