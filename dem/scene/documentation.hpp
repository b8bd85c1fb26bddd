// The page docs/scene.md, generated from the table of keys.
#pragma once
#include <string>

namespace isostat {

std::string scene_documentation();

}  // namespace isostat
