// Scene files: TOML in, checked Scene out. docs/scene.md lists the keys.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "dem/scene/scene.hpp"

namespace isostat {

// Reads and checks a scene; each override is "KEY=VALUE" as given to --set (dotted key, TOML value, stages as
// stage.N.KEY), later ones win. Throws InputError with every fault of the file and the overrides.
Scene read_scene(const std::string& path, const std::vector<std::string>& overrides = {});

enum class SceneChecks {
  all,   // keys, types, ranges, and the rules between keys: a scene that is about to run
  keys,  // keys, types and ranges only: the record of a scene in a state file
};

// The same from text; `name` stands for the file in faults.
Scene parse_scene(std::string_view text, const std::string& name, const std::vector<std::string>& overrides = {},
                  SceneChecks checks = SceneChecks::all);

}  // namespace isostat
