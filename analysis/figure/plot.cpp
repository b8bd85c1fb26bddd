#include "analysis/figure/plot.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "dem/files/atomic_file.hpp"
#include "dem/input_error.hpp"

namespace isostat {
namespace {

// The plot of that name if the file has its data, or the only one that applies.
template <class Plots, class Data>
const auto& chosen(const Plots& plots, const Data& data, const std::string& path, const std::string& what) {
  std::string possible, all;
  const typename Plots::value_type *named = nullptr, *only = nullptr;
  int count = 0;
  for (const auto& plot : plots) {
    all += (all.empty() ? "" : ", ") + std::string(plot.name);
    if (plot.name == what) named = &plot;
    if (!plot.applies(data)) continue;
    possible += (possible.empty() ? "" : ", ") + std::string(plot.name);
    only = &plot, ++count;
  }
  if (named) return *named;
  if (!what.empty()) throw InputError(path, 0, "--what", what, "such a file may hold " + all);
  if (count == 0) throw InputError(path, 0, "", "", "holds nothing to plot; a file of its kind may hold " + all);
  if (count > 1) throw InputError(path, 0, "--what", "", "choose one of what this file holds: " + possible);
  return *only;
}

}  // namespace

Plot read_plot(const std::string& path, const std::string& what) {
  const std::string extension = std::filesystem::path(path).extension().string();
  if (extension == ".csv") {
    const DataTable table = parse_table(read_whole_file(path), path);
    return chosen(table_plots(), table, path, what).make(table);
  }
  if (extension != ".json") throw InputError(path, 0, "", "", "plot reads .json results and .csv tables");
  nlohmann::json result;
  try {
    result = nlohmann::json::parse(read_whole_file(path));
  } catch (const nlohmann::json::exception& error) {
    throw InputError(path, 0, "", "", std::string("is no JSON: ") + error.what());
  }
  return chosen(json_plots(), result, path, what).make(result, path);
}

}  // namespace isostat
