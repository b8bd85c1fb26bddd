// What a stored state of grains of triangles obeys beside dem/state/state_check.hpp.
#pragma once
#include "dem/state/state_check.hpp"
#include "dem/triangles/triangles.hpp"

namespace isostat {

std::optional<StateFault> packing_fault(const TrianglePacking& packing);
std::optional<StateFault> memory_fault(const TriangleMemory& memory, const TrianglePacking& packing);
std::optional<StateFault> law_fault(const TriangleLaw& law);

}  // namespace isostat
