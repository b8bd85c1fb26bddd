// The ensemble table of `isostat study` (docs/study.md) as a chart: one column against another.
#pragma once
#include <string>

#include "analysis/figure/data_table.hpp"
#include "analysis/figure/plot.hpp"

namespace isostat {

// Points of y with their standard error (column Y_se) against x. One curve for each choice of the parameters other than
// x; one for all rows if x is a result. Against a key of the stages that are rows (stage.pressure) a curve joins the
// stages of a set in their order: a load path goes forth and back. A column is named in full or by the end of its name
// after a point. Throws InputError for unknown, ambiguous or non-numeric columns, and where no row has both numbers.
// Colours go on from the given one, which is left after the last.
Plot study_plot(const DataTable& table, const std::string& x, const std::string& y, std::size_t& color);

}  // namespace isostat
