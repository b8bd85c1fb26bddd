// Rows of fields under named columns: CSV and its relatives, LAMMPS dumps.
//
// A table of text is split at semicolons, commas, tabs or white space, whichever its first line has first in this
// order; where that is not the comma, a comma inside a number is a decimal one. Blank lines and lines that begin with #
// are left out. The first line names the columns. If it is numbers alone, the names are those of the comment above it
// (`# x y z r`, or YADE's
// `#format x_y_z_r`), and without one the columns are called 1, 2, ...
#pragma once
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace isostat {

struct TextTable {
  TextTable() = default;
  TextTable(TextTable&&) = default;
  TextTable& operator=(TextTable&&) = default;

  std::string path;
  int header_line = 0;  // 0: the file has no line of names
  std::vector<std::string> columns;
  std::vector<std::string_view> cells;  // row by row; views into `owned`, which keeps its strings in place
  std::vector<int> lines;               // in the file, of the rows
  std::deque<std::string> owned;
  std::size_t rows() const { return lines.size(); }
  std::optional<std::size_t> column(std::string_view name) const;
  std::string_view cell(std::size_t row, std::size_t col) const { return cells[row * columns.size() + col]; }
  std::string_view& cell(std::size_t row, std::size_t col) { return cells[row * columns.size() + col]; }
};

// Throws InputError for rows of another length than the first line.
TextTable parse_table(std::string text, const std::string& path);

// Whether the first line of a text may be that of such a table: names or numbers, at least two.
bool begins_like_table(std::string_view text);

}  // namespace isostat
