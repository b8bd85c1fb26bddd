// Rules that tie several scene keys together. The rules of single keys are in the table of keys (dem/scene/keys.hpp).
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

std::string stage_key(std::size_t stage, const char* key);  // full name of a key of a [[stage]]

// The rules of the scene's system (dem/systems.cpp).
std::vector<SceneConflict> system_conflicts(const Scene& scene);

// Weight and container, and what the stages do with them; of every system.
std::vector<SceneConflict> surroundings_conflicts(const Scene& scene);

// Walls in motion against the time step of a run and the size of its smallest grain: a period has at least 20 steps,
// and no wall jumps into grains.
std::vector<SceneConflict> wall_motion_conflicts(const Scene& scene, double time_step, double smallest_size);

// The keys of a stage that move or load the cell, as far as they are given.
std::vector<std::string> cell_keys(const StageScene& stage, std::size_t index);

// Every broken rule, each at most once a stage. The values are taken to be in their own ranges.
std::vector<SceneConflict> conflicts(const Scene& scene);

}  // namespace isostat
