#include "analysis/structure/power_fit.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <vector>

namespace isostat {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kSmallestRange = 2;        // k_high / k_low
constexpr double kLargestSlopeChange = .2;  // of a power law, if it is significant

// Weighted least squares of y against 1, x, and if asked x^2 - (a combination that is orthogonal to both).
struct Line {
  double mean_x = 0, mean_y = 0, slope = 0, slope_error = 0, curve = 0, curve_error = 0, chi2 = 0;
};

Line line_through(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& w) {
  Line f;
  double sw = 0, sx = 0, sy = 0;
  for (std::size_t n = 0; n < x.size(); ++n) sw += w[n], sx += w[n] * x[n], sy += w[n] * y[n];
  f.mean_x = sx / sw, f.mean_y = sy / sw;
  double xx = 0, xy = 0, xxx = 0;
  for (std::size_t n = 0; n < x.size(); ++n) {
    const double u = x[n] - f.mean_x;
    xx += w[n] * u * u, xy += w[n] * u * (y[n] - f.mean_y), xxx += w[n] * u * u * u;
  }
  f.slope = xy / xx, f.slope_error = 1 / std::sqrt(xx);
  double qq = 0, qy = 0;  // q = u^2 - (xxx/xx) u - xx/sw is orthogonal to 1 and u
  for (std::size_t n = 0; n < x.size(); ++n) {
    const double u = x[n] - f.mean_x, q = u * u - xxx / xx * u - xx / sw, rest = y[n] - f.mean_y - f.slope * u;
    qq += w[n] * q * q, qy += w[n] * q * rest, f.chi2 += w[n] * rest * rest;
  }
  f.curve = qy / qq, f.curve_error = 1 / std::sqrt(qq);
  return f;
}

}  // namespace

PowerFit fit_power(std::span<const double> k, std::span<const double> intensity, std::span<const double> modes,
                   double low, double high) {
  if (k.size() != intensity.size() || k.size() != modes.size())
    throw std::invalid_argument("fit_power: as many intensities and modes as wave numbers");
  std::vector<double> x, y, w;
  PowerFit fit;
  fit.exponent = fit.error = fit.amplitude = fit.slope_change = fit.slope_change_error = fit.chi2_per_dof = kNaN;
  for (std::size_t n = 0; n < k.size(); ++n) {
    if (!(k[n] >= low && k[n] <= high && intensity[n] > 0 && modes[n] > 0)) continue;
    if (x.empty()) fit.window[0] = k[n];
    fit.window[1] = k[n];
    x.push_back(std::log(k[n])), y.push_back(std::log(intensity[n])), w.push_back(modes[n]);
  }
  fit.points = static_cast<int>(x.size());
  if (fit.points < kFewestBins) {
    fit.message = "fewer bins in the window than a straight line with a test of it needs";
    return fit;
  }
  const Line line = line_through(x, y, w);
  const double range = x.back() - x.front();
  fit.exponent = -line.slope, fit.error = line.slope_error;
  fit.amplitude = std::exp(line.mean_y - line.slope * line.mean_x);
  fit.slope_change = -2 * line.curve * range, fit.slope_change_error = 2 * line.curve_error * range;
  fit.chi2_per_dof = line.chi2 / (fit.points - 2);
  if (std::exp(range) < kSmallestRange) {
    fit.message = "the window is too narrow to tell an exponent: less than a factor 2";
  } else if (std::abs(fit.slope_change) > std::max(2 * fit.slope_change_error, kLargestSlopeChange)) {
    char text[96];
    std::snprintf(text, sizeof text, "no power law: the slope changes by %.2f +- %.2f across the window",
                  fit.slope_change, fit.slope_change_error);
    fit.message = text;
  }
  fit.identifiable = fit.message.empty();
  return fit;
}

}  // namespace isostat
