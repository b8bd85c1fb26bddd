// The rows of the scene that only triangles have.
#pragma once
#include <vector>

#include "dem/scene/keys.hpp"

namespace isostat {

std::vector<SceneKey> triangle_keys();

}  // namespace isostat
