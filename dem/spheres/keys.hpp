// The rows of the table of scene keys that are about spheres (dem/scene/keys.hpp).
#pragma once
#include <vector>

#include "dem/scene/keys.hpp"

namespace isostat {

std::vector<SceneKey> sphere_keys();

}  // namespace isostat
