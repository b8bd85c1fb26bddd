#include "analysis/figure/data_table.hpp"

#include <algorithm>
#include <charconv>
#include <limits>
#include <optional>

#include "dem/input_error.hpp"
#include "dem/scene/suggestion.hpp"

namespace isostat {
namespace {

std::string_view trimmed(std::string_view s) {
  while (!s.empty() && (s.front() == ' ' || s.front() == '\t')) s.remove_prefix(1);
  while (!s.empty() && (s.back() == ' ' || s.back() == '\t' || s.back() == '\r')) s.remove_suffix(1);
  return s;
}

// Fields of one line; within quotes commas count as text and "" as a quote.
std::vector<std::string> fields(std::string_view line) {
  std::vector<std::string> all;
  std::string field;
  bool quoted = false, was_quoted = false;
  const auto end_field = [&] {
    all.push_back(was_quoted ? field : std::string(trimmed(field)));
    field.clear();
    was_quoted = false;
  };
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quoted && c == '"' && i + 1 < line.size() && line[i + 1] == '"') {
      field += c, ++i;
    } else if (c == '"' && (quoted || trimmed(field).empty())) {
      quoted = !quoted;
      if (quoted) field.clear(), was_quoted = true;
    } else if (c == ',' && !quoted) {
      end_field();
    } else {
      field += c;
    }
  }
  end_field();
  return all;
}

std::optional<double> number(const std::string& text) {
  if (text.empty() || text == "nan" || text == "NaN" || text == "-nan" || text == "null")
    return std::numeric_limits<double>::quiet_NaN();
  double x = 0;
  const char *begin = text.data() + (text[0] == '+'), *end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(begin, end, x);
  if (stop != end || error != std::errc()) return std::nullopt;
  return x;
}

}  // namespace

const DataColumn* DataTable::find(std::string_view name) const {
  const auto it = std::find_if(columns.begin(), columns.end(), [&](const DataColumn& c) { return c.name == name; });
  return it == columns.end() ? nullptr : &*it;
}

const DataColumn& column_named(const DataTable& table, const char* option, const std::string& name) {
  const DataColumn* found = table.find(name);
  std::vector<std::string> names, ends;
  for (const DataColumn& c : table.columns) {
    names.push_back(c.name);
    if (c.name.ends_with("." + name)) ends.push_back(c.name);
  }
  if (!found && ends.size() > 1) {
    std::string list;
    for (const std::string& end : ends) list += (list.empty() ? "" : ", ") + end;
    throw InputError(table.path, 0, option, name, "may mean " + list);
  }
  if (!found && ends.size() == 1) found = table.find(ends[0]);
  if (!found) {
    const std::string hint = did_you_mean(name, names);
    throw InputError(table.path, 0, option, name, "no such column; " + (hint.empty() ? "the header lists them" : hint));
  }
  if (!found->numeric()) throw InputError(table.path, 0, option, name, "holds no numbers");
  return *found;
}

DataTable parse_table(std::string_view text, const std::string& path) {
  DataTable table{path, {}};
  std::vector<Fault> faults;
  int number_of_line = 0;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    std::string_view line = trimmed(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    ++number_of_line;
    if (line.empty() || line.front() == '#') continue;
    const std::vector<std::string> row = fields(line);
    if (table.columns.empty()) {
      for (const std::string& name : row) table.columns.push_back({name, {}, {}});
      continue;
    }
    if (row.size() != table.columns.size()) {
      faults.push_back({path, number_of_line, "", std::to_string(row.size()) + " fields",
                        "the header has " + std::to_string(table.columns.size())});
      if (faults.size() >= 100) break;
      continue;
    }
    for (std::size_t c = 0; c < row.size(); ++c) table.columns[c].text.push_back(row[c]);
  }
  if (!faults.empty()) throw InputError(std::move(faults));
  if (table.rows() == 0) throw InputError(path, 0, "", "", "has no rows: a table starts with its header line");
  for (DataColumn& column : table.columns) {
    std::vector<double> values;
    for (const std::string& field : column.text) {
      const auto x = number(field);
      if (!x) break;
      values.push_back(*x);
    }
    const bool some =
        std::any_of(column.text.begin(), column.text.end(), [](const std::string& s) { return !s.empty(); });
    if (values.size() == column.text.size() && some) column.value = std::move(values);
  }
  return table;
}

}  // namespace isostat
