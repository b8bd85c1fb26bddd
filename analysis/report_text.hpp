// A report in other clothes: a table for the terminal, and CSV files.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "analysis/report.hpp"

namespace isostat {

// One line a number under the section's name; long arrays by their length only.
std::string report_as_text(const nlohmann::ordered_json& report);

// CSV files (name without directory, content) from what a report holds (docs/report.md):
//   SECTION.csv          key,value of its single numbers and words; of an ensemble key,mean,sd,se
//   SECTION.table.csv    its arrays of one common length side by side (an array NAME_edges as NAME_left, NAME_right)
//   SECTION.NAME.csv     a lone array (index,NAME), a histogram (left,right,density) or a list of objects
// In an ensemble an array column NAME is followed by NAME_sd and NAME_se.
std::vector<std::pair<std::string, std::string>> report_as_csv(const nlohmann::ordered_json& report);

// Header and rows; integers as such, other reals with 17 digits.
std::string table_as_csv(const Table& table);

}  // namespace isostat
