// Rules that tie several scene keys together. The rules of single keys are in dem/scene/keys.cpp.
#pragma once
#include <string>
#include <vector>

#include "dem/scene/scene.hpp"

namespace isostat {

struct SceneConflict {
  std::string key;                    // the key to change first, full name
  std::string value;                  // as resolved
  std::string rule;                   // what is allowed, and what to change
  std::vector<std::string> involved;  // all keys the rule looks at
};

// Every broken rule, each at most once a stage. The values are taken to be in their own ranges.
std::vector<SceneConflict> conflicts(const Scene& scene);

}  // namespace isostat
