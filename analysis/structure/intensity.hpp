// Orientation average of I(k) = |chi_hat(k)|^2 / A over the reciprocal lattice (Gilabert 2007, Eq. 25).
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "analysis/structure/fractal_fit.hpp"
#include "analysis/structure/power_fit.hpp"
#include "geometry/disk_transform.hpp"

namespace isostat {

struct IntensityCurve {
  std::vector<double> k_edges;      // [1/length] n + 1; a bin holds k_edges[b] <= k < k_edges[b+1]
  std::vector<double> k;            // mean |k| in the bin [1/length]; NaN in empty bins
  std::vector<double> intensity;    // plain mean over the bin [length^2]; NaN in empty bins
  std::vector<double> sigma;        // its standard error; NaN below two modes
  std::vector<std::int64_t> modes;  // k and -k counted once
};

// sigma = sqrt(mean square deviation of the modes / n), the convention of the checked cases; in bins of few modes it is
// low by sqrt((n - 1)/n) and noisy, which is why fits take I_model / sqrt(n) instead.

// Edges that several samples can share: k_max times powers of 10^(-1/kBinsPerDecade), down to below k_min.
inline constexpr int kBinsPerDecade = 20;
std::vector<double> anchored_edges(double k_min, double k_max);

// All nonzero modes of the transform are binned; edges increasing.
IntensityCurve average_intensity(const DiskTransform& transform, std::vector<double> k_edges);

// One curve for several samples with the same edges: all their modes together (samples count by their modes).
IntensityCurve pooled_intensity(std::span<const IntensityCurve> curves);

// Eq. 28 fitted to the bins with modes in [k_low, k_high], sigma = I_model / sqrt(modes).
FractalFit fit_curve(const IntensityCurve& curve, double k_low, double k_high,
                     FitConstant constant = FitConstant::free);
FractalFit refit_curve(const IntensityCurve& curve, double k_low, double k_high, FitConstant constant,
                       const FractalFit& start);

// Eq. 26 fitted to them.
PowerFit fit_curve_power(const IntensityCurve& curve, double k_low, double k_high);

}  // namespace isostat
