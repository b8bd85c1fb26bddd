// The rows of the table of scene keys that are about disks (dem/scene/keys.hpp).
#pragma once
#include <vector>

#include "dem/scene/keys.hpp"

namespace isostat {

std::vector<SceneKey> disk_keys();

}  // namespace isostat
