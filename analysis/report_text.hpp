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

// The single numbers and words of a report's sections under dotted keys (counts.z, stress.tensor.0.1), in its order; of
// an ensemble {"mean", "sd", "se"}. Arrays that are columns, histograms and lists are left out.
std::vector<std::pair<std::string, nlohmann::ordered_json>> report_scalars(const nlohmann::ordered_json& report);

// A line for each report of one input: `file`, then its scalars as SECTION.KEY, in the order in which they first
// appear.
std::string reports_as_table(const std::vector<nlohmann::ordered_json>& reports);

// One field of a CSV file: null is empty, a boolean 0 or 1, a real has 17 digits, words are quoted where they must be.
std::string csv_field(const nlohmann::ordered_json& value);

// Header and rows; integers as such, other reals with 17 digits.
std::string table_as_csv(const Table& table);

}  // namespace isostat
