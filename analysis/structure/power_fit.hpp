// Eq. 26 of Gilabert 2007: I(k) ~ k^-d_F in a window, a straight line of ln I against ln k.
#pragma once
#include <array>
#include <span>
#include <string>

namespace isostat {

struct PowerFit {
  double exponent = 0, error = 0;                   // d_F, and its standard error by the modes
  double amplitude = 0;                             // I(k) = amplitude k^-d_F
  double slope_change = 0, slope_change_error = 0;  // of -d ln I/d ln k from one end of the window to the other
  double chi2_per_dof = 0;                          // of the straight line
  int points = 0;
  bool identifiable = false;
  std::string message;             // what is wrong when it is not
  std::array<double, 2> window{};  // [1/length] of the points used
};

// Weighted by modes: ln I of a bin is known to 1/sqrt(modes). Points with intensity > 0 and low <= k <= high; NaNs are
// left out. Not identifiable below kFewestBins points, in a window of less than a factor 2, or where the slope changes
// across the window by more than twice the error of that change and by more than 0.2: then it is no power law.
inline constexpr int kFewestBins = 4;
PowerFit fit_power(std::span<const double> k, std::span<const double> intensity, std::span<const double> modes,
                   double low, double high);

}  // namespace isostat
