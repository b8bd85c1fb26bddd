#include "analysis/figure/chart_range.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace isostat {
namespace {

constexpr double kNothing = 1e-290;  // below it, the steps of an axis are no normal numbers: shown as 0
constexpr double kLinearMargin = 0.04, kLogMargin = 0.05;  // [range] kept free at both ends

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
  void add(double v) { low = std::min(low, v), high = std::max(high, v); }
  bool empty() const { return low > high; }
};

Axis fitted(const ChartAxis& wish, Range range, bool from_zero) {
  if (range.empty()) throw std::invalid_argument("no value to show");
  Axis axis{wish.title, wish.log, 0, 1, wish.whole};
  if (wish.log) {
    if (range.low == range.high) range.low /= 2, range.high *= 2;
    const double stretch = std::pow(range.high / range.low, kLogMargin);
    axis.low = range.low / stretch, axis.high = range.high * stretch;
  } else {
    if (from_zero) range.add(0);
    // flat up to rounding: a range of its own, so that rounding noise isn't blown up to the size of the frame
    const double size = std::max(std::abs(range.low), std::abs(range.high));
    if (range.high - range.low <= 1e-12 * size || size < kNothing) {
      const double half = size >= kNothing ? 0.05 * size : 1;
      range.low -= half, range.high += half;
    }
    const double margin = kLinearMargin * (range.high - range.low);
    axis.low = from_zero && range.low == 0 ? 0 : range.low - margin;
    axis.high = range.high + margin;
  }
  if (wish.low) axis.low = *wish.low;
  if (wish.high) axis.high = *wish.high;
  return axis;
}

}  // namespace

BarPlace bar_place(const Chart& chart, std::size_t curve, double x) {
  constexpr double kAll = 0.8;  // of the unit between integers
  std::size_t count = 0, index = 0;
  for (std::size_t c = 0; c < chart.curves.size(); ++c)
    if (chart.curves[c].style == CurveStyle::bars) {
      if (c == curve) index = count;
      ++count;
    }
  const double width = kAll / static_cast<double>(count), left = x - kAll / 2 + static_cast<double>(index) * width;
  return {left, left + width};
}

Axis fitted_x_axis(const Chart& chart) {
  const Axis any{{}, chart.x.log};
  Range range;
  bool tight = true;
  for (std::size_t c = 0; c < chart.curves.size(); ++c) {
    const Curve& curve = chart.curves[c];
    const bool edges = curve.style == CurveStyle::steps || curve.style == CurveStyle::cells;
    tight = tight && edges;
    for (std::size_t i = 0; i < curve.x.size(); ++i) {
      if (!any.shows(curve.x[i])) continue;
      if (curve.style == CurveStyle::bars) {
        range.add(curve.x[i] - 0.6), range.add(curve.x[i] + 0.6);
      } else if (edges || (i < curve.y.size() && std::isfinite(curve.y[i]) && (!chart.y.log || curve.y[i] > 0))) {
        range.add(curve.x[i]);
      }
    }
  }
  Axis axis = fitted(chart.x, range, false);
  if (tight && range.low < range.high) axis.low = range.low, axis.high = range.high;
  return axis;
}

Axis fitted_y_axis(const Chart& chart, const Axis& x) {
  const Axis any{{}, chart.y.log};
  Range range;
  bool from_zero = false;
  for (const Curve& curve : chart.curves) {
    if (curve.style == CurveStyle::cells) {
      for (const double edge : curve.x2) range.add(edge);
      continue;
    }
    from_zero = from_zero || curve.style == CurveStyle::steps || curve.style == CurveStyle::bars;
    for (std::size_t i = 0; i < curve.y.size(); ++i) {
      const double at = curve.x[i];
      if (!any.shows(curve.y[i]) || !x.shows(at) || at > x.high || (curve.style != CurveStyle::steps && at < x.low))
        continue;
      range.add(curve.y[i]);
      if (i < curve.error.size() && std::isfinite(curve.error[i])) {
        range.add(curve.y[i] + curve.error[i]);
        // a log axis shows the lower end of a bar down to a quarter of its value, and clips the rest
        const double low = curve.y[i] - curve.error[i];
        const bool from_floor = curve.style == CurveStyle::steps || curve.style == CurveStyle::bars;
        range.add(chart.y.log ? std::max(low, curve.y[i] / 4) : from_floor ? std::max(low, 0.0) : low);
      }
    }
  }
  return fitted(chart.y, range, from_zero && !chart.y.log);
}

}  // namespace isostat
