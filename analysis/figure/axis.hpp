// One axis of a chart: a range of values, its way onto the page, and its ticks.
#pragma once
#include <vector>

#include "analysis/figure/rich_text.hpp"

namespace isostat {

struct Tick {
  double value = 0;
  RichText label;  // empty: a minor tick
};

struct Axis {
  RichText title;
  bool log = false;
  double low = 0, high = 1;  // log: both positive
  bool whole = false;        // counts: ticks at integers only

  bool shows(double value) const;       // can be drawn: finite, and positive on a log axis
  double fraction(double value) const;  // 0 at low, 1 at high; log: by the logarithm
};

// Ticks inside [low, high], about one label every `spacing` of the axis length (both in points). A linear axis of very
// large or small numbers shares a power of ten, given in `factor` ("x 10^{-5}").
struct Ticks {
  std::vector<Tick> ticks;
  RichText factor;
};
Ticks ticks(const Axis& axis, double length, double spacing);

}  // namespace isostat
