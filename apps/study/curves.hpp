// Curves from the time series of a study's samples, as stress against strain: means over the samples, and their peaks.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "analysis/figure/data_table.hpp"
#include "apps/study/expression.hpp"

namespace isostat {

// y against x, expressions of the columns of the series, during one stage.
struct SeriesCurve {
  std::string name, x_text;
  Expression x, y;
  double step = 0;  // of x: y is averaged within [k step, (k + 1) step)
  std::size_t stage = 0;
};

struct CurvePoint {
  double x = 0, y = 0;  // middle of a bin, mean of y in it
};

// The bins that the sample has been in, in order of x. Throws InputError where the series lacks a column.
std::vector<CurvePoint> curve_of_sample(const SeriesCurve& curve, const DataTable& series);

}  // namespace isostat
