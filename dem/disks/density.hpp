// How dense the random start of disks may be.
#pragma once

namespace isostat {

inline constexpr double kDensestAtRandom = 0.5;  // [-] solid fraction that random sequential placement reaches
// [-] of a gas of hard disks (dem/sample/hard_gas.hpp), uniform up to 0.70; beyond it disks are pushed apart
// (dem/sample/push_apart.hpp)
inline constexpr double kDensestGas = 0.65;

}  // namespace isostat
