// What a stored state of spheres obeys beside dem/state/state_check.hpp.
#pragma once
#include "dem/spheres/spheres.hpp"
#include "dem/state/state_check.hpp"

namespace isostat {

std::optional<StateFault> memory_fault(const SphereMemory& memory, const SpherePacking& packing);
std::optional<StateFault> law_fault(const SphereLaw& law);

}  // namespace isostat
