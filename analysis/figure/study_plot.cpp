#include "analysis/figure/study_plot.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "dem/input_error.hpp"
#include "dem/scene/suggestion.hpp"

namespace isostat {
namespace {

const DataColumn& column(const DataTable& table, const char* option, const std::string& name) {
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

std::string_view leaf(std::string_view name) { return name.substr(name.rfind('.') + 1); }

// The columns between `row` and `runs` are what the study has set; those that differ from row to row tell rows apart.
std::vector<const DataColumn*> parameters(const DataTable& table) {
  std::vector<const DataColumn*> list;
  for (std::size_t c = 1; c < table.columns.size() && table.columns[c].name != "runs"; ++c)
    list.push_back(&table.columns[c]);
  return list;
}

std::string label_of(const std::vector<const DataColumn*>& columns, std::size_t row) {
  std::string text;
  for (const DataColumn* c : columns)
    if (!c->text[row].empty()) text += (text.empty() ? "" : ", ") + std::string(leaf(c->name)) + " = " + c->text[row];
  return text;
}

}  // namespace

Plot study_plot(const DataTable& table, const std::string& x_name, const std::string& y_name) {
  if (table.columns[0].name != "row" || !table.find("runs"))
    throw InputError(table.path, 0, "--what", "study", "is for the study.csv of isostat study");
  const DataColumn &x = column(table, "--x", x_name), &y = column(table, "--y", y_name);
  const DataColumn* error = table.find(y.name + "_se");
  if (error && !error->numeric()) error = nullptr;  // one sample a row

  std::vector<const DataColumn*> telling = parameters(table);
  const bool against_parameter = std::find(telling.begin(), telling.end(), &x) != telling.end();
  std::erase_if(telling, [&](const DataColumn* c) {
    return !against_parameter || c == &x ||
           std::all_of(c->text.begin(), c->text.end(), [&](const std::string& t) { return t == c->text[0]; });
  });

  struct Point {
    double x, y, error;
  };
  std::vector<std::string> order;
  std::map<std::string, std::vector<Point>> groups;
  for (std::size_t r = 0; r < table.rows(); ++r) {
    if (!std::isfinite(x.value[r]) || !std::isfinite(y.value[r])) continue;
    const std::string label = label_of(telling, r);
    if (!groups.contains(label)) order.push_back(label);
    groups[label].push_back({x.value[r], y.value[r], error ? error->value[r] : NAN});
  }
  if (order.empty()) throw InputError(table.path, 0, "--y", y_name, "no row has a number here and in " + x.name);

  Chart chart;
  chart.x.title = plain(x.name);
  chart.y.title = plain(y.name);
  for (std::size_t k = 0; k < order.size(); ++k) {
    std::vector<Point>& points = groups[order[k]];
    std::stable_sort(points.begin(), points.end(), [](const Point& a, const Point& b) { return a.x < b.x; });
    Curve marks{plain(order[k]), CurveStyle::points, {}, {}, {}, {}, curve_color(k)};
    for (const Point& p : points) {
      marks.x.push_back(p.x), marks.y.push_back(p.y);
      if (error) marks.error.push_back(std::isfinite(p.error) ? p.error : 0);
    }
    if (against_parameter && points.size() > 1) {
      Curve line{{}, CurveStyle::line, marks.x, marks.y, {}, {}, blend(curve_color(k), kWhite, 0.45)};
      chart.curves.push_back(std::move(line));
    }
    chart.curves.push_back(std::move(marks));
  }
  return {{chart}, false};
}

}  // namespace isostat
