// The energies of a state of disks.
#pragma once
#include "dem/disks/disks.hpp"
#include "dem/state/energy.hpp"

namespace isostat {

Energies energies(const State<Disks>& state);

}  // namespace isostat
