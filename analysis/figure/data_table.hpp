// A CSV table: a header line, then rows; lines that start with '#' are comments. Fields may be quoted.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace isostat {

struct DataColumn {
  std::string name;
  std::vector<std::string> text;
  std::vector<double> value;  // empty unless every field is a number, empty or "nan" (the latter two: NaN)
  bool numeric() const { return !value.empty(); }
};

struct DataTable {
  std::string path;
  std::vector<DataColumn> columns;
  std::size_t rows() const { return columns.empty() ? 0 : columns[0].text.size(); }
  const DataColumn* find(std::string_view name) const;  // null if there is none
};

// The column of that name, or the only one whose name ends in it after a point. Throws InputError for an unknown,
// ambiguous or non-numeric one; `option` is where the name was given.
const DataColumn& column_named(const DataTable& table, const char* option, const std::string& name);

// Throws InputError naming lines with another number of fields than the header, or a table without rows.
DataTable parse_table(std::string_view text, const std::string& path);

}  // namespace isostat
