#include "dem/sample/size_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace isostat {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// Of the law e^(2 x t) on t in [-1/2, 1/2]: twice the mean, the Langevin function, and its slope in x, four times the
// variance of t.
double langevin(double x) {
  if (std::abs(x) < 1e-2) return x / 3 - x * x * x / 45 + 2 * std::pow(x, 5) / 945;
  return 1 / std::tanh(x) - 1 / x;
}
double langevin_slope(double x) {
  if (std::abs(x) < 1e-2) return 1.0 / 3 - x * x / 15 + 2 * std::pow(x, 4) / 189;
  const double s = std::sinh(std::min(std::abs(x), 300.0));
  return 1 / (x * x) - 1 / (s * s);
}

// Monotone, so bisection finds it; |m| < 1, and |x| > 1 / (1 - |m|) never.
double inverse_langevin(double m) {
  const double most = 2 / (1 - std::abs(m));
  double low = -most, high = most;
  for (int k = 0; k < 200 && low < high; ++k) {
    const double x = (low + high) / 2;
    if (x == low || x == high) break;
    (langevin(x) < m ? low : high) = x;
  }
  return (low + high) / 2;
}

}  // namespace

Exponent likely_exponent(const std::vector<double>& radii, double radius_min, double radius_max) {
  const double l = std::log(radius_max / radius_min), n = static_cast<double>(radii.size());
  if (radii.empty() || !(l > 0)) return {kNaN, kNaN};
  double sum = 0;
  for (const double r : radii) sum += std::clamp(std::log(r / radius_min) / l, 0.0, 1.0) - 0.5;
  const double m = 2 * sum / n;  // y = L (t + 1/2), weight e^(s y): x = s L / 2
  if (!(std::abs(m) < 1)) return {m > 0 ? -INFINITY : INFINITY, kNaN};
  const double x = inverse_langevin(m);
  return {1 - 2 * x / l, 2 / (l * std::sqrt(n * langevin_slope(x)))};
}

SizeHistogram size_histogram(const std::vector<double>& radii, double radius_min, double radius_max, int bins) {
  SizeHistogram h;
  const double l = std::log(radius_max / radius_min);
  for (int k = 0; k <= bins; ++k) h.edge.push_back(radius_min * std::exp(l * k / bins));
  h.edge.back() = radius_max;
  h.count.resize(static_cast<std::size_t>(bins));
  for (const double r : radii) {
    const auto above = std::upper_bound(h.edge.begin(), h.edge.end(), r) - h.edge.begin();
    ++h.count[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(above - 1, 0, bins - 1))];
  }
  for (std::size_t k = 0; k < h.count.size(); ++k) {
    h.middle.push_back(std::sqrt(h.edge[k] * h.edge[k + 1]));
    h.density.push_back(static_cast<double>(h.count[k]) /
                        (static_cast<double>(radii.size()) * (h.edge[k + 1] - h.edge[k])));
  }
  return h;
}

PowerFit fit_power_law(const SizeHistogram& histogram) {
  double n = 0, mean_x = 0, mean_y = 0, xx = 0, xy = 0, rest = 0;
  std::vector<double> x, y;
  for (std::size_t k = 0; k < histogram.count.size(); ++k)
    if (histogram.count[k] > 0) x.push_back(std::log(histogram.middle[k])), y.push_back(std::log(histogram.density[k]));
  n = static_cast<double>(x.size());
  PowerFit fit{kNaN, kNaN, kNaN, x.size()};
  if (x.size() < 3) return fit;
  for (std::size_t k = 0; k < x.size(); ++k) mean_x += x[k] / n, mean_y += y[k] / n;
  for (std::size_t k = 0; k < x.size(); ++k)
    xx += (x[k] - mean_x) * (x[k] - mean_x), xy += (x[k] - mean_x) * (y[k] - mean_y);
  const double slope = xy / xx;
  for (std::size_t k = 0; k < x.size(); ++k) rest += std::pow(y[k] - mean_y - slope * (x[k] - mean_x), 2);
  fit.exponent = -slope;
  fit.exponent_error = std::sqrt(rest / (n - 2) / xx);
  fit.prefactor = std::exp(mean_y - slope * mean_x);
  return fit;
}

}  // namespace isostat
