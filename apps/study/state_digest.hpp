// Which state a file holds: what a study has to know of the states in its folder, read once as long as they stay.
#pragma once
#include <cstdint>
#include <string>

#include "dem/scene/scene.hpp"

namespace isostat {

struct StateDigest {
  std::string hash;  // physical_hash
  std::uint64_t seed = 0;
  Scene scene;  // resolved
};

// Remembers files by name, size and time of change. Throws InputError if the file cannot be read or is no state.
const StateDigest& state_digest(const std::string& path);

}  // namespace isostat
