// The one table of scene keys: parsing, checking, --set, documentation and the resolved echo all follow from it. To add
// a key: a field with a default in dem/scene/scene.hpp, and one row in dem/scene/keys.cpp; for a key of one system the
// same in its folder.
#pragma once
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "dem/scene/scene.hpp"

namespace isostat {

// Where the value of a key lives in a scene; the alternative is the type of the key.
using SceneField =
    std::variant<bool*, int*, std::uint64_t*, double*, std::optional<double>*, std::string*, std::vector<double>*,
                 Finish*, Until*, Springs*, VelocityOf*, SceneSystem*, ContainerShape*, ContainerWalls*, Integrator*,
                 Arrangement*, ContactLaw*, BeamFailure*, NormalForce*, SphereArrangement*, SizeLaw*, ShareOf*>;

// Systems that have a key. Keys of one name in two systems are two rows, with defaults and ranges of their own.
class SystemSet {
 public:
  static constexpr SystemSet all() { return SystemSet(~0u); }
  static constexpr SystemSet only(SceneSystem s) { return SystemSet(bit(s)); }
  static constexpr SystemSet both(SceneSystem s, SceneSystem t) { return SystemSet(bit(s) | bit(t)); }
  constexpr bool has(SceneSystem s) const { return bits_ & bit(s); }
  friend constexpr bool operator==(SystemSet, SystemSet) = default;

 private:
  constexpr explicit SystemSet(unsigned bits) : bits_(bits) {}
  static constexpr unsigned bit(SceneSystem s) { return 1u << static_cast<unsigned>(s); }
  unsigned bits_;
};

std::string names_of(SystemSet systems);  // "disks and spheres"

struct SceneRange {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false, high_open = false;
  bool contains(double x) const {  // false for NaN and for the infinities
    return (low_open ? x > low : x >= low) && (high_open ? x < high : x <= high) && x - x == 0;
  }
};

struct SceneCondition {
  bool (*holds)(const Scene& scene) = nullptr;  // nullptr: always
  std::string_view in_words{};
};

struct SceneKey {
  std::string_view name;                                 // dotted; keys of a [[stage]] are `stage.KEY`
  SceneField (*field)(Scene& scene, std::size_t stage);  // stage: which [[stage]], for its keys
  std::string_view unit{};                               // in the words of disks (unit_text()); empty: not a quantity
  SceneRange range{};                                    // numbers, and each element of a list
  std::vector<std::string_view> choices{};               // texts: what is allowed; empty: anything
  std::string_view absent{};                             // what leaving out an optional key means
  SceneCondition condition{};                            // where it does not hold the key is ignored
  SystemSet systems = SystemSet::all();
  bool hidden_at_default = false;  // at its default it is left out of the echo, as if the key were not there
  std::string_view meaning;        // one sentence
};

std::vector<SceneKey> system_keys();        // the rows of all systems (dem/systems.cpp)
std::vector<SceneKey> surroundings_keys();  // gravity, [container], and what a stage does with it
const std::vector<SceneKey>& scene_keys();  // in the order of documentation and echo; names may come twice
const std::vector<SceneKey>& scene_keys(SceneSystem system);  // those that it has
bool belongs_to_stage(const SceneKey& key);
bool belongs_to_units(const SceneKey& key);

// The name with its stage: `stage.pressure` of stage 0 is `stage.0.pressure`.
std::string full_name(const SceneKey& key, std::size_t stage);

std::string table_of(const SceneKey& key);      // empty at top level
std::string_view leaf_of(const SceneKey& key);  // the name within its table

// False: the key is ignored in this scene, or one of another system.
bool applies(const SceneKey& key, const Scene& scene);

}  // namespace isostat
