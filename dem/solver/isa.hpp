// Which instruction set a run takes. Of disks: batches of 1, 8 and 16 pairs.
#pragma once
#include "geometry/base/isa.hpp"

namespace isostat {

Isa best_isa();  // of this machine and build; the environment variable ISOSTAT_ISA may ask for less

}  // namespace isostat
