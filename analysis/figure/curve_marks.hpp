// Curves on the page: their marks, and the points that a legend must not cover.
#pragma once
#include "analysis/figure/chart.hpp"

namespace isostat {

// A chart's frame on the page with its axes.
struct ChartFrame {
  Rect box;
  Axis x, y;
  Vec2 page(double vx, double vy) const {
    return {{box.x + box.width * x.fraction(vx), box.bottom() - box.height * y.fraction(vy)}};
  }
};

void draw_curve(Canvas& canvas, const ChartFrame& frame, const Chart& chart, std::size_t curve);
// The symbol of a curve in the legend, in a box of this width centred on the height of `left`.
void draw_sample(Canvas& canvas, const Vec2& left, double width, const Chart& chart, std::size_t curve);

// Page points spread over the curve (lines and the area under steps and bars filled in), about 4 pt apart.
std::vector<Vec2> covered_points(const ChartFrame& frame, const Chart& chart, std::size_t curve);

// The same line with at most four points in each quarter of a point along x: first, lowest, highest, last.
std::vector<Vec2> thinned(const std::vector<Vec2>& line);

}  // namespace isostat
