// Any columns of any CSV tables against another one: one chart, one curve a table and column.
#pragma once
#include <string>
#include <vector>

#include "analysis/figure/data_table.hpp"
#include "analysis/figure/plot.hpp"

namespace isostat {

// Error bars where a table has a column Y_se. Few rows are points joined by lines, many a line, in the order of the
// file: what is loaded and unloaded goes forth and back. Throws InputError as column_named() does, and for a column
// without a row that has both numbers.
Plot column_plot(const std::vector<DataTable>& tables, const std::string& x, const std::vector<std::string>& y);

// Symbol and unit of the columns of a series, others by their name.
RichText column_title(const DataTable& table, const std::string& name);

}  // namespace isostat
