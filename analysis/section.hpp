// A section of the report, and the tables that go with it.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/input.hpp"

namespace isostat {

// A table of numbers that goes with a section into `--csv DIR` as DIR/NAME.csv.
struct Table {
  std::string name;
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;
};

// A section: name, and a function from input to its JSON value. Throws InputError if it does not apply.
struct Section {
  std::string_view name;
  nlohmann::ordered_json (*compute)(const AnalysisInput&, const AnalysisOptions&);
  // Rows too many for the report, computed only for --csv. What the JSON value holds becomes tables by itself.
  std::vector<Table> (*tables)(const AnalysisInput&, const AnalysisOptions&) = nullptr;
  // Ensembles of binned curves: brings the values of several inputs onto common bins before they are merged entry by
  // entry; false: they have none, and the merged report keeps one value an input.
  bool (*align)(std::vector<nlohmann::ordered_json>&) = nullptr;
  // What is computed from all inputs together and not by averaging; stands as "pooled" in the merged section.
  nlohmann::ordered_json (*pooled)(const std::vector<nlohmann::ordered_json>&) = nullptr;
  // Long to compute or to read: left out unless it is named.
  bool only_when_named = false;
};
}  // namespace isostat
