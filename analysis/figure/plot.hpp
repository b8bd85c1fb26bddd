// What `isostat plot` can make of a file: charts of the JSON of `analyze` and `lab`, and of CSV tables.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/figure/chart.hpp"
#include "analysis/figure/data_table.hpp"

namespace isostat {

struct Plot {
  std::vector<Chart> charts;
  bool share_x = false;
};

// One meaning of a file: `applies` sees whether it has the data, `make` draws it. `path` names the file in faults.
struct JsonPlot {
  std::string_view name;
  bool (*applies)(const nlohmann::json& result);
  Plot (*make)(const nlohmann::json& result, const std::string& path);  // throws InputError
};
const std::vector<JsonPlot>& json_plots();

struct TablePlot {
  std::string_view name;
  bool (*applies)(const DataTable& table);
  Plot (*make)(const DataTable& table);  // throws InputError
};
const std::vector<TablePlot>& table_plots();

// Reads the file (.json, .csv) and makes the plot of that name; an empty name stands for the only one that applies.
// Throws InputError for a file that cannot be read or that the plot does not apply to, listing those that do.
Plot read_plot(const std::string& path, const std::string& what);

}  // namespace isostat
