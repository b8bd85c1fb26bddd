// The instruction sets that kernels are compiled for, and which of them this machine has.
#pragma once
#include <string_view>

namespace isostat {

enum class Isa { scalar, avx2, avx512 };  // of disks: batches of 1, 8 and 16 pairs
Isa best_isa();  // of this machine and build; the environment variable ISOSTAT_ISA may ask for less
std::string_view name(Isa isa);

}  // namespace isostat
