#include "analysis/figure/study_plot.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

#include "analysis/figure/column_plot.hpp"
#include "dem/input_error.hpp"

namespace isostat {
namespace {

std::string_view leaf(std::string_view name) { return name.substr(name.rfind('.') + 1); }

// The columns between `row` and `runs` are what the study has set; those that differ from row to row tell rows apart.
std::vector<const DataColumn*> parameters(const DataTable& table) {
  std::vector<const DataColumn*> list;
  for (std::size_t c = 1; c < table.columns.size() && table.columns[c].name != "runs"; ++c)
    list.push_back(&table.columns[c]);
  return list;
}

// Differs between the stages of one set: its number, and its keys.
bool of_stage(std::string_view name) {
  return name == "stage" || (name.starts_with("stage.") && !std::isdigit(static_cast<unsigned char>(name[6])));
}

std::string label_of(const std::vector<const DataColumn*>& columns, std::size_t row) {
  std::string text;
  for (const DataColumn* c : columns)
    if (!c->text[row].empty()) text += (text.empty() ? "" : ", ") + std::string(leaf(c->name)) + " = " + c->text[row];
  return text;
}

}  // namespace

Plot study_plot(const DataTable& table, const std::string& x_name, const std::string& y_name, std::size_t& color) {
  if (table.columns[0].name != "row" || !table.find("runs"))
    throw InputError(table.path, 0, "--what", "study", "is for the study.csv of isostat study");
  const DataColumn &x = column_named(table, "--x", x_name), &y = column_named(table, "--y", y_name);
  const DataColumn* error = table.find(y.name + "_se");
  if (error && !error->numeric()) error = nullptr;  // one sample a row

  std::vector<const DataColumn*> telling = parameters(table);
  const bool against_parameter = std::find(telling.begin(), telling.end(), &x) != telling.end();
  const bool path = of_stage(x.name);  // forth and back, in the order of the stages
  std::erase_if(telling, [&](const DataColumn* c) {
    return !against_parameter || c == &x || (path && of_stage(c->name)) ||
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
  chart.x.title = column_title(table, x.name);
  chart.y.title = column_title(table, y.name);
  for (std::size_t k = 0; k < order.size(); ++k) {
    std::vector<Point>& points = groups[order[k]];
    if (!path) std::stable_sort(points.begin(), points.end(), [](const Point& a, const Point& b) { return a.x < b.x; });
    const Color paint = curve_color(color++);
    Curve marks{plain(order[k]), CurveStyle::points, {}, {}, {}, {}, paint};
    for (const Point& p : points) {
      marks.x.push_back(p.x), marks.y.push_back(p.y);
      if (error) marks.error.push_back(std::isfinite(p.error) ? p.error : 0);
    }
    if (against_parameter && points.size() > 1) {
      Curve line{{}, CurveStyle::line, marks.x, marks.y, {}, {}, blend(paint, kWhite, 0.45)};
      chart.curves.push_back(std::move(line));
    }
    chart.curves.push_back(std::move(marks));
  }
  return {{chart}, false};
}

}  // namespace isostat
