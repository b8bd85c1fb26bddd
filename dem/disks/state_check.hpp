// What a stored state of disks obeys beside dem/state/state_check.hpp.
#pragma once
#include "dem/disks/disks.hpp"
#include "dem/state/state_check.hpp"

namespace isostat {

std::optional<StateFault> memory_fault(const DiskMemory& memory, const Packing<2>& packing);
std::optional<StateFault> law_fault(const DiskLaw& law);

}  // namespace isostat
