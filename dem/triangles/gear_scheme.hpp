// Gear's predictor-corrector of fourth order, five values, for second-order equations: r, v dt, a dt^2/2, b dt^3/6,
// c dt^4/24 are predicted by Taylor's series and corrected by kGearCorrector[k] times the error of the third. Allen and
// Tildesley, "Computer Simulation of Liquids" (1987), App. E; Poeschel and Buchholtz 1995, Sec. 5.
#pragma once
#include <array>

namespace isostat {

// Of forces that depend on velocity, as dampers do (19/120 in place of 19/90 for those that don't).
inline constexpr std::array<double, 5> kGearCorrector{19.0 / 90, 3.0 / 4, 1, 1.0 / 2, 1.0 / 12};

// Pascal's triangle: value k is predicted as the sum over l >= k of kGearPredictor[k][l] times value l.
inline constexpr std::array<std::array<double, 5>, 5> kGearPredictor{
    {{1, 1, 1, 1, 1}, {0, 1, 2, 3, 4}, {0, 0, 1, 3, 6}, {0, 0, 0, 1, 4}, {0, 0, 0, 0, 1}}};

}  // namespace isostat
