// Curves in a frame with axes, and several such frames above each other.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "analysis/figure/axis.hpp"
#include "analysis/figure/canvas.hpp"

namespace isostat {

enum class CurveStyle {
  line,
  dashed,
  points,  // with error bars where `error` is given
  cloud,   // very many small dots
  steps,   // histogram: x holds the n + 1 edges of the n values in y
  bars,    // y at integer x, side by side with the other bars of the chart
  cells    // two-dimensional histogram: x and x2 hold edges, y the values row by row; coloured by log value
};

struct Curve {
  RichText label;  // empty: not in the legend
  CurveStyle style = CurveStyle::line;
  std::vector<double> x, y;
  std::vector<double> error;  // of y, or empty
  std::vector<double> x2;     // cells: edges along the y axis
  Color color = kCurves[0];
};

struct ChartAxis {
  RichText title;
  bool log = false;
  std::optional<double> low, high;  // absent: from the data
  bool whole = false;               // counts: ticks at integers only
};

struct Chart {
  ChartAxis x, y;
  std::vector<Curve> curves;
  std::vector<RichText> notes;  // lines in the legend, after the curves
  double height = 250;          // [pt] of the frame
  bool equal_units = false;     // one unit is as long on both axes
};

// Sizes that the reader may want otherwise [pt].
struct ChartStyle {
  double width = 380;            // of the frames
  std::optional<double> height;  // of every frame; absent: each chart's own
  double text = 9.5;             // titles are one larger
};

// Charts with the same x axis share it when stacked: only the lowest shows its numbers.
class ChartFigure {
 public:
  // Throws std::invalid_argument for a chart without any value that its axes can show.
  explicit ChartFigure(std::vector<Chart> charts, bool share_x = false, const ChartStyle& style = {});
  Vec2 size() const { return size_; }  // [pt] of the page
  void draw(Canvas& canvas) const;

 private:
  struct Panel {
    Chart chart;
    Axis x, y;
    Rect frame;
    bool labels_x = true;
  };
  std::vector<Panel> panels_;
  ChartStyle style_;
  Vec2 size_{};
};

}  // namespace isostat
