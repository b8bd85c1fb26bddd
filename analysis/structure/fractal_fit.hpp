// Least-squares fits of the fractal laws of Gilabert 2007: I(k) of Eq. 28 and C(r) of Eq. 27.
//
// Eq. 28: I(k) = constant + amplitude Gamma(d_F) xi^d_F 2F1((1 + d_F)/2, d_F/2; 1; -xi^2 k^2).
// Eq. 27: C(r) - Phi^2 = amplitude r^(d_F - 2) exp(-r/xi). Phi and l enter through one amplitude only:
// 2 pi Phi l^(2 - d_F) in Eq. 28, Phi l^(2 - d_F) in Eq. 27. Fitted are ln amplitude, d_F, ln xi and the constant.
#pragma once
#include <array>
#include <span>
#include <string>
#include <vector>

#include "analysis/structure/fit_constant.hpp"

namespace isostat {

double fractal_intensity(double k, double d_f, double xi, double amplitude, double constant);
double fractal_correlation(double r, double d_f, double xi, double amplitude);

struct FractalFit {
  // Order of parameters in `error` and `correlation`: d_F, xi [length], amplitude, constant.
  double d_f = 0, xi = 0, amplitude = 0, constant = 0;
  std::array<double, 4> error{};  // standard errors from the given sigmas
  std::array<std::array<double, 4>, 4> correlation{};
  double chi2 = 0;
  int points = 0, parameters = 4;
  bool constant_held = false;      // at 0: errors and correlations of the constant are then 0 and not a number
  int starts = 0, agreeing = 0;    // starts tried, and those that ended at the best optimum
  bool identifiable = false;       // one optimum, inside the range that the window can tell
  std::string message;             // what is wrong when it is not
  std::array<double, 2> window{};  // [1/length or length] of the points used
  double chi2_per_dof() const { return chi2 / (points - parameters); }
};

// Weighted fit of Eq. 28 from a grid of starts (Levenberg-Marquardt of GSL). k [1/length] increasing, sigma > 0; needs
// at least 5 points, otherwise not identifiable. Throws std::invalid_argument for sizes that differ.
FractalFit fit_intensity(std::span<const double> k, std::span<const double> intensity, std::span<const double> sigma);

// The same with sigma = I_model / sqrt(modes), iterated: each |chi_hat|^2 is distributed exponentially about its mean,
// so weights from the data themselves would favour the low points.
// nonnegative: where the free optimum has a constant below 0, that with the constant held at 0.
FractalFit fit_intensity_by_modes(std::span<const double> k, std::span<const double> intensity,
                                  std::span<const double> modes, FitConstant constant = FitConstant::free);

// The same from one start alone, the optimum of a similar curve: for resamples. `identifiable` says only that the
// optimum lies in the range that the window can tell.
FractalFit refit_intensity_by_modes(std::span<const double> k, std::span<const double> intensity,
                                    std::span<const double> modes, FitConstant constant, const FractalFit& start);

// Unweighted fit of Eq. 27 (three parameters, `constant` 0); errors from the scatter about the fit, which are too small
// where points are correlated.
FractalFit fit_correlation(std::span<const double> r, std::span<const double> excess);
FractalFit refit_correlation(std::span<const double> r, std::span<const double> excess, const FractalFit& start);

}  // namespace isostat
