// The time series of a run: one CSV row an observation. docs/formats.md lists the columns; each system makes its own
// (series_columns() beside its state).
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace isostat {

// Name and value of a quantity at one instant: header and rows come from the same list.
struct SeriesColumn {
  std::string_view name;
  double value;
};

std::string series_header(const std::vector<SeriesColumn>& columns);  // both with their newline
std::string series_row(const std::vector<SeriesColumn>& columns);     // 17 significant digits

}  // namespace isostat
