#include "dem/run/series.hpp"

#include <cstdio>

namespace isostat {

std::string series_header(const std::vector<SeriesColumn>& columns) {
  std::string header;
  for (const SeriesColumn& c : columns) header.append(header.empty() ? "" : ",").append(c.name);
  return header + "\n";
}

std::string series_row(const std::vector<SeriesColumn>& columns) {
  std::string row;
  for (const SeriesColumn& c : columns) {
    char text[32];
    std::snprintf(text, sizeof text, "%.17g", c.value);
    row.append(row.empty() ? "" : ",").append(text);
  }
  return row + "\n";
}

}  // namespace isostat
