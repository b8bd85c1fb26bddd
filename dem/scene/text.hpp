// Scene values as text: TOML literals that parse back, and the rules that the keys obey in words.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "dem/scene/keys.hpp"

namespace isostat {

// The value as a TOML literal that parses back to the same value; empty for an absent optional.
std::string value_text(const SceneKey& key, const Scene& scene, std::size_t stage);
std::string real_text(double value);              // shortest digits that parse back, always with a point or exponent
std::string quoted_text(std::string_view value);  // a TOML basic string

// Type and allowed values in words: "real > 0".
std::string rule_text(const SceneKey& key);

// The unit of a key: common rows hold the words of disks, which other systems call by their own.
struct UnitWord {
  std::string_view disks, triangles, spheres;
};
const std::vector<UnitWord>& unit_words();
std::string_view unit_text(const SceneKey& key, SceneSystem system);

// A scene of this system in which every key has a home: one stage, and units.
Scene scene_with_every_key(SceneSystem system);

// False: the key does not apply, or it is hidden at the value that it has.
bool echoed(const SceneKey& key, const Scene& scene, std::size_t stage);

// Every key with its value, as a scene file that read_scene turns into an equal Scene. Keys that do not apply are left
// out, and so are absent optional ones.
std::string scene_to_toml(const Scene& scene);

}  // namespace isostat
