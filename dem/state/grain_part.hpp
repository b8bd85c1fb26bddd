// What a body or a grain is a part of.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace isostat {

// Walls move with the container, whatever pushes them. A lid closes an outlet: a wall that goes when it is opened.
enum class GrainPart : std::uint8_t { free, wall, lid };

// Of a list that is empty where all are free.
inline bool is_free(const std::vector<GrainPart>& part, std::size_t k) {
  return part.empty() || part[k] == GrainPart::free;
}

}  // namespace isostat
