#include "analysis/report_text.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>

#include "analysis/report_units.hpp"
#include "dem/files/formats/real_text.hpp"

namespace isostat {
namespace {

using Json = nlohmann::ordered_json;

bool is_statistic(const Json& v) { return v.is_object() && v.contains("mean") && v.contains("se"); }
bool is_histogram(const Json& v) { return v.is_object() && v.contains("edges") && v.contains("density"); }
bool is_scalar(const Json& v) { return !v.is_structured() || is_statistic(v); }
bool is_column(const Json& v) {
  return v.is_array() && !v.empty() && std::all_of(v.begin(), v.end(), [](const Json& e) { return is_scalar(e); });
}

// A field of a CSV file: null is empty, words are quoted where they must be.
std::string field(const Json& v) {
  if (v.is_null() || (v.is_number_float() && !std::isfinite(v.get<double>()))) return "";
  if (v.is_boolean()) return v.get<bool>() ? "1" : "0";
  if (v.is_number_integer()) return std::to_string(v.get<std::int64_t>());
  std::string text;
  if (v.is_number()) {
    append_real(text, v.get<double>());
    return text;
  }
  text = v.is_string() ? v.get<std::string>() : v.dump();
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

std::string short_number(const Json& v) {
  if (v.is_null()) return "-";
  if (!v.is_number_float()) return v.is_string() ? v.get<std::string>() : v.dump();
  if (!std::isfinite(v.get<double>())) return "-";
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.6g", v.get<double>());
  return buffer;
}
std::string short_text(const Json& v) {
  if (is_statistic(v))
    return short_number(v["mean"]) + " +- " + short_number(v["se"]) + " (sd " + short_number(v["sd"]) + ")";
  if (!v.is_array()) return short_number(v);
  constexpr std::size_t kMostShown = 12;
  if (v.size() > kMostShown) return "[" + std::to_string(v.size()) + " values]";
  std::string text = "[";
  for (const Json& e : v)
    text += (text.size() > 1 ? ", " : "") + (e.is_object() && !is_statistic(e) ? "..." : short_text(e));
  return text + "]";
}

// A fit without a result is said to be one, and its numbers are not shown.
bool is_untold(const Json& fit) { return fit.contains("identifiable") && fit["identifiable"] == false; }

void add_line(std::string& text, const std::string& name, const std::string& value) {
  std::string line = "  " + name;
  line.resize(std::max<std::size_t>(line.size() + 2, 32), ' ');
  text += line + value + '\n';
}

// `unit` knows the unit of a dotted name.
template <class Unit>
void add_lines(std::string& text, const std::string& prefix, const Json& object, const Unit& unit) {
  for (const auto& [key, v] : object.items()) {
    const std::string name = prefix + key;
    if (is_histogram(v)) {
      continue;  // for --json and --csv
    } else if (v.is_object() && is_untold(v)) {
      const Json message = v.value("message", Json());
      add_line(text, name, "NOT IDENTIFIABLE" + (message.is_string() ? ": " + message.get<std::string>() : ""));
    } else if (v.is_object() && !is_statistic(v)) {
      add_lines(text, name + ".", v, unit);
    } else {
      const std::string of = unit(name), number = short_text(v);
      add_line(text, name, number + (of.empty() || number == "-" ? "" : " " + of));
    }
  }
}

// Square, of two or three rows; other arrays of arrays are lists by input.
bool is_tensor(const Json& v) {
  return v.is_array() && v.size() >= 2 && v.size() <= 3 && std::all_of(v.begin(), v.end(), [&](const Json& row) {
           return row.is_array() && row.size() == v.size() && std::all_of(row.begin(), row.end(), is_scalar);
         });
}

// Single numbers, also in nested objects and tensors, under dotted keys.
void add_scalars(std::vector<std::pair<std::string, const Json*>>& rows, const std::string& prefix, const Json& v) {
  if (is_scalar(v)) {
    rows.emplace_back(prefix, &v);
  } else if (v.is_object() && !is_histogram(v)) {
    for (const auto& [key, member] : v.items())
      if (!is_column(member)) add_scalars(rows, prefix.empty() ? key : prefix + "." + key, member);
  } else if (is_tensor(v)) {
    for (std::size_t k = 0; k < v.size(); ++k)
      for (std::size_t l = 0; l < v.size(); ++l)
        rows.emplace_back(prefix + "." + std::to_string(k) + "." + std::to_string(l), &v[k][l]);
  }
}

std::string scalars_csv(const Json& section) {
  std::vector<std::pair<std::string, const Json*>> rows;
  add_scalars(rows, "", section);
  if (rows.empty()) return "";
  const bool ensemble = std::any_of(rows.begin(), rows.end(), [](const auto& r) { return is_statistic(*r.second); });
  std::string text = ensemble ? "key,mean,sd,se\n" : "key,value\n";
  for (const auto& [key, v] : rows) {
    text += key + ',';
    if (is_statistic(*v))
      text += field((*v)["mean"]) + ',' + field((*v)["sd"]) + ',' + field((*v)["se"]) + '\n';
    else
      text += field(*v) + (ensemble ? ",,\n" : "\n");
  }
  return text;
}

struct Column {
  std::string name;
  std::vector<Json> values;
};

std::string columns_csv(const std::vector<Column>& columns) {
  std::string header, text;
  std::vector<bool> ensemble;
  for (const Column& c : columns) {
    ensemble.push_back(std::any_of(c.values.begin(), c.values.end(), is_statistic));
    header += (header.empty() ? "" : ",") + c.name;
    if (ensemble.back()) header += "," + c.name + "_sd," + c.name + "_se";
  }
  for (std::size_t row = 0; row < columns.front().values.size(); ++row) {
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const Json& v = columns[c].values[row];
      if (c > 0) text += ',';
      if (!ensemble[c])
        text += field(v);
      else if (is_statistic(v))
        text += field(v["mean"]) + ',' + field(v["sd"]) + ',' + field(v["se"]);
      else
        text += field(v) + ",,";
    }
    text += '\n';
  }
  return header + '\n' + text;
}

std::string histogram_csv(const Json& h) {
  const Json& e = h["edges"];
  std::vector<Column> c;
  const auto add = [](Column& column, const Json& v) { column.values.push_back(v); };
  if (e.size() == 2 && e[0].is_array()) {  // two variables: one row a bin
    c = {{"x_left", {}}, {"x_right", {}}, {"y_left", {}}, {"y_right", {}}, {"density", {}}};
    for (std::size_t x = 0; x + 1 < e[0].size(); ++x)
      for (std::size_t y = 0; y + 1 < e[1].size(); ++y)
        add(c[0], e[0][x]), add(c[1], e[0][x + 1]), add(c[2], e[1][y]), add(c[3], e[1][y + 1]),
            add(c[4], h["density"][x][y]);
  } else {
    c = {{"left", {e.begin(), e.end() - 1}}, {"right", {e.begin() + 1, e.end()}}};
    for (const auto& [key, v] : h.items())  // the density, and what else is told of each bin
      if (key != "edges" && v.is_array() && v.size() + 1 == e.size()) c.push_back({key, {v.begin(), v.end()}});
  }
  return columns_csv(c);
}

std::string objects_csv(const Json& list) {
  std::vector<Column> columns;
  for (const Json& object : list)
    for (const auto& [key, v] : object.items())
      if (is_scalar(v) &&
          std::none_of(columns.begin(), columns.end(), [&, k = key](const Column& c) { return c.name == k; }))
        columns.push_back({key, {}});
  for (const Json& object : list)
    for (Column& c : columns) c.values.push_back(object.contains(c.name) ? object[c.name] : Json());
  return columns.empty() ? "" : columns_csv(columns);
}

// Arrays of one length side by side; NAME_edges of a length more joins as NAME_left, NAME_right.
void add_array_tables(std::vector<std::pair<std::string, std::string>>& files, const std::string& name,
                      const Json& section) {
  std::map<std::size_t, std::vector<Column>> groups;
  for (const auto& [key, v] : section.items()) {
    if (!is_column(v)) continue;
    if (key.ends_with("_edges") && v.size() > 1) {
      const std::string base = key.substr(0, key.size() - 6);
      groups[v.size() - 1].push_back({base + "_left", {v.begin(), v.end() - 1}});
      groups[v.size() - 1].push_back({base + "_right", {v.begin() + 1, v.end()}});
    } else {
      groups[v.size()].push_back({key, {v.begin(), v.end()}});
    }
  }
  for (auto& [length, columns] : groups) {
    if (columns.size() > 1) {
      files.emplace_back(name + ".table.csv", columns_csv(columns));
      continue;
    }
    Column index{"index", {}};
    for (std::size_t k = 0; k < length; ++k) index.values.emplace_back(k);
    files.emplace_back(name + "." + columns[0].name + ".csv", columns_csv({index, columns[0]}));
  }
}

void add_nested(std::vector<std::pair<std::string, std::string>>& files, const std::string& name, const Json& v) {
  if (is_histogram(v)) {
    files.emplace_back(name + ".csv", histogram_csv(v));
  } else if (v.is_object() && !is_statistic(v)) {
    for (const auto& [key, member] : v.items())
      if (key != "histograms" || !member.is_object())
        add_nested(files, name + "." + key, member);
      else
        for (const auto& [which, h] : member.items()) add_nested(files, name + "." + which, h);
  } else if (v.is_array() && !v.empty() &&
             std::all_of(v.begin(), v.end(), [](const Json& e) { return e.is_object() && !is_statistic(e); })) {
    if (std::string text = objects_csv(v); !text.empty()) files.emplace_back(name + ".csv", std::move(text));
  }
}

bool is_section(const std::string& key) {
  return key != "isostat" && key != "inputs" && key != "units" && key != "warnings";
}

}  // namespace

std::string report_as_text(const Json& report) {
  std::string text;
  const Json units = report.value("units", Json::object());
  for (const auto& [key, v] : report.items()) {
    if (!is_section(key) || !v.is_object()) continue;
    text += key + '\n';
    add_lines(text, "", v,
              [&, section = key](const std::string& name) { return unit_of(section + "." + name, units); });
  }
  for (const Json& warning : report.value("warnings", Json::array()))
    text += "warning: " + warning.get<std::string>() + '\n';
  if (!units.empty() && !units.contains("length")) text += "numbers with a unit are in that of the input file\n";
  return text;
}

std::vector<std::pair<std::string, std::string>> report_as_csv(const Json& report) {
  std::vector<std::pair<std::string, std::string>> files;
  for (const auto& [key, v] : report.items()) {
    if (!is_section(key) || !v.is_object()) continue;
    if (std::string text = scalars_csv(v); !text.empty()) files.emplace_back(key + ".csv", std::move(text));
    add_array_tables(files, key, v);
    add_nested(files, key, v);
  }
  return files;
}

std::vector<std::pair<std::string, Json>> report_scalars(const Json& report) {
  std::vector<std::pair<std::string, const Json*>> rows;
  for (const auto& [key, v] : report.items())
    if (is_section(key) && v.is_object()) add_scalars(rows, key, v);
  std::vector<std::pair<std::string, Json>> scalars;
  for (const auto& [key, v] : rows) scalars.emplace_back(key, *v);
  return scalars;
}

std::string reports_as_table(const std::vector<Json>& reports) {
  std::vector<Column> columns{{"file", {}}};
  std::map<std::string, std::size_t> column_of;
  for (std::size_t row = 0; row < reports.size(); ++row) {
    columns[0].values.push_back(reports[row].at("inputs").at(0));
    for (const auto& [key, value] : report_scalars(reports[row])) {
      const auto [at, added] = column_of.emplace(key, columns.size());
      if (added) columns.push_back({key, {}});
      columns[at->second].values.resize(row);  // null in the reports that lack it
      columns[at->second].values.push_back(value);
    }
  }
  for (Column& c : columns) c.values.resize(reports.size());
  return columns_csv(columns);
}

std::string csv_field(const Json& value) { return field(value); }

std::string table_as_csv(const Table& table) {
  std::string text;
  for (const std::string& c : table.columns) text += (text.empty() ? "" : ",") + c;
  text += '\n';
  for (const auto& row : table.rows) {
    for (std::size_t k = 0; k < row.size(); ++k) {
      if (k > 0) text += ',';
      if (std::isfinite(row[k])) append_real(text, row[k]);
    }
    text += '\n';
  }
  return text;
}

}  // namespace isostat
