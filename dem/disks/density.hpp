// How dense the random start of disks may be.
#pragma once

namespace isostat {

inline constexpr double kDensestAtRandom = 0.5;  // [-] solid fraction that random sequential placement reaches
inline constexpr double kDensestGas = 0.65;  // [-] of a gas of hard disks (dem/sample/hard_gas.hpp), uniform up to 0.70

}  // namespace isostat
