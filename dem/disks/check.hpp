// Rules that tie scene keys of disks together (dem/scene/check.hpp).
#pragma once
#include <vector>

#include "dem/scene/check.hpp"

namespace isostat {

std::vector<SceneConflict> disk_conflicts(const Scene& scene);

}  // namespace isostat
