#include "analysis/network/histogram.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/base/index.hpp"

namespace isostat {
namespace {

struct Bins {
  double width;
  long first = 0, count = 0;  // bin k covers [(first + k) width, (first + k + 1) width)
  long index(double v) const { return static_cast<long>(std::floor(v / width)) - first; }
  std::vector<double> edges() const {
    std::vector<double> e;
    for (long k = 0; count > 0 && k <= count; ++k) e.push_back(static_cast<double>(first + k) * width);
    return e;
  }
};

Bins anchored_bins(const std::vector<double>& values, double width) {
  Bins bins{width};
  if (values.empty()) return bins;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  while ((*high - *low) / bins.width > kMostBins - 2) bins.width *= 2;
  bins.first = static_cast<long>(std::floor(*low / bins.width));
  bins.count = bins.index(*high) + 1;
  return bins;
}

}  // namespace

Histogram anchored_histogram(const std::vector<double>& values, double width) {
  const Bins bins = anchored_bins(values, width);
  Histogram h{bins.edges(), std::vector<double>(idx(bins.count), 0.0)};
  for (const double v : values) h.density[idx(bins.index(v))] += 1 / (bins.width * static_cast<double>(values.size()));
  return h;
}

Histogram histogram_over(const std::vector<double>& values, std::vector<double> edges) {
  Histogram h{std::move(edges), {}};
  h.density.assign(h.edges.size() - 1, 0.0);
  for (const double v : values) {
    if (!(v >= h.edges.front() && v <= h.edges.back())) continue;
    const auto above = std::upper_bound(h.edges.begin(), h.edges.end(), v) - h.edges.begin();
    h.density[std::min(idx(above) - 1, h.density.size() - 1)] += 1;
  }
  for (std::size_t k = 0; k < h.density.size(); ++k)
    h.density[k] /= static_cast<double>(values.size()) * (h.edges[k + 1] - h.edges[k]);
  return h;
}

Histogram2 anchored_histogram_2(const std::vector<double>& x, const std::vector<double>& y, double width) {
  constexpr int kMostCells = 400;  // a side
  double w = width;
  Bins bx = anchored_bins(x, w), by = anchored_bins(y, w);
  while (bx.count > kMostCells || by.count > kMostCells || bx.width != by.width) {
    w = std::max({2 * w, bx.width, by.width});
    bx = anchored_bins(x, w), by = anchored_bins(y, w);
  }
  Histogram2 h{bx.edges(), by.edges(), {}};
  h.density.assign(idx(bx.count), std::vector<double>(idx(by.count), 0.0));
  const double weight = 1 / (w * w * static_cast<double>(x.size()));
  for (std::size_t k = 0; k < x.size(); ++k) h.density[idx(bx.index(x[k]))][idx(by.index(y[k]))] += weight;
  return h;
}

PowerLaw fit_power_law(const std::vector<double>& values, double low, double high) {
  const double undefined = std::numeric_limits<double>::quiet_NaN();
  const double range = std::log(high / low);
  double sum = 0;
  long count = 0;
  for (const double v : values)
    if (v >= low && v < high) sum += std::log(v / low) / range, ++count;
  if (count < kFewestForFit) return {undefined, undefined, count};
  const double mean = sum / static_cast<double>(count);
  // u = ln(v/low)/range in [0, 1) has density ~ exp(s u), s = (1 - q) range. Its mean is 1/(1 - exp(-s)) - 1/s,
  // increasing in s: bisection. Its variance is the Fisher information of s.
  const auto mean_of = [](double s) { return std::abs(s) < 1e-4 ? 0.5 + s / 12 : 1 / -std::expm1(-s) - 1 / s; };
  double lower = -700, upper = 700;
  for (int k = 0; k < 200; ++k) (mean_of(0.5 * (lower + upper)) < mean ? lower : upper) = 0.5 * (lower + upper);
  const double s = 0.5 * (lower + upper);
  const double variance =
      std::abs(s) < 1e-2 ? 1.0 / 12 - s * s / 240 : 1 / (s * s) - 1 / (4 * std::sinh(s / 2) * std::sinh(s / 2));
  return {1 - s / range, 1 / (range * std::sqrt(static_cast<double>(count) * variance)), count};
}

}  // namespace isostat
