// The range of values that a chart's axes must show.
#pragma once
#include "analysis/figure/chart.hpp"

namespace isostat {

// With a margin, and rounded bounds where the axis gives them. Throws std::invalid_argument if no value can be shown.
Axis fitted_x_axis(const Chart& chart);
Axis fitted_y_axis(const Chart& chart, const Axis& x);

// Lower and upper edge of the i-th bar among the chart's bar curves [x units].
struct BarPlace {
  double left = 0, right = 0;
};
BarPlace bar_place(const Chart& chart, std::size_t curve, double x);

}  // namespace isostat
