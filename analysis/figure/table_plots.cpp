// CSV tables as charts: the series of `pack`, work-precision and other benchmarks, contact lists.
#include <algorithm>
#include <cmath>
#include <map>

#include "analysis/figure/plot.hpp"
#include "dem/input_error.hpp"

namespace isostat {
namespace {

[[noreturn]] void refuse(const DataTable& table, const char* what, std::string why) {
  throw InputError(table.path, 0, "--what", what, std::move(why));
}

bool starts_with_any(const std::string& name, std::initializer_list<std::string_view> heads) {
  return std::any_of(heads.begin(), heads.end(), [&](std::string_view head) { return name.starts_with(head); });
}

bool has_positive(const std::vector<double>& values) {
  return std::any_of(values.begin(), values.end(), [](double v) { return std::isfinite(v) && v > 0; });
}
bool has_finite(const std::vector<double>& values) {
  return std::any_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

// --- series: every column against time, related ones in one panel ---

struct SeriesPanel {
  const char* title;
  bool log;
  std::vector<std::pair<const char*, const char*>> columns;  // name in the file, label
};

const std::vector<SeriesPanel>& series_panels() {
  static const std::vector<SeriesPanel> panels = {
      {"Φ", false, {{"Phi", ""}}},
      {"`L` / `a`", false, {{"L1", "`L`_{1}"}, {"L2", "`L`_{2}"}, {"L3", "`L`_{3}"}}},
      {"stress",
       false,
       {{"sigma11", "`σ`_{11}"},
        {"sigma22", "`σ`_{22}"},
        {"sigma33", "`σ`_{33}"},
        {"sigma12", "`σ`_{12}"},
        {"sigma13", "`σ`_{13}"},
        {"sigma23", "`σ`_{23}"},
        {"imposed11", "imposed `σ`_{11}"},
        {"imposed22", "imposed `σ`_{22}"},
        {"imposed33", "imposed `σ`_{33}"}}},
      {"strain of the stage",
       false,
       {{"strain1", "direction 1"}, {"strain2", "direction 2"}, {"strain3", "direction 3"}}},
      {"strain rate",
       false,
       {{"strain_rate1", "direction 1"}, {"strain_rate2", "direction 2"}, {"strain_rate3", "direction 3"}}},
      {"`z`", false, {{"z", ""}}},
      {"clusters", true, {{"clusters", ""}}},
      {"kinetic energy", true, {{"kinetic_energy", ""}}},
      {"criteria",
       true,
       {{"max_force", "net force"},
        {"max_moment", "net moment"},
        {"pressure_error", "pressure error"},
        {"kinetic_energy_per_grain", "kinetic energy"}}},
      {"energy",
       false,
       {{"E_kinetic", "kinetic"},
        {"E_elastic", "elastic"},
        {"E_adhesive", "adhesive"},
        {"E_viscous", "viscous"},
        {"E_sliding", "sliding"},
        {"E_rolling", "rolling"},
        {"E_drag", "drag"},
        {"E_cell_work", "cell work"},
        {"E_beams", "beams"},
        {"E_overlaps", "overlaps"},
        {"E_springs", "springs"},
        {"E_weight", "weight"},
        {"E_total", "total"}}},
      {"grains", false, {{"grains", "free"}, {"grains_left", "left"}, {"grains_above", "above the outlet"}}},
      {"Φ of slices, bottom",
       false,
       {{"Phi_01", "1"},
        {"Phi_02", "2"},
        {"Phi_03", "3"},
        {"Phi_04", "4"},
        {"Phi_05", "5"},
        {"Phi_06", "6"},
        {"Phi_07", "7"},
        {"Phi_08", "8"}}},
      {"Φ of slices, top",
       false,
       {{"Phi_09", "9"},
        {"Phi_10", "10"},
        {"Phi_11", "11"},
        {"Phi_12", "12"},
        {"Phi_13", "13"},
        {"Phi_14", "14"},
        {"Phi_15", "15"},
        {"Phi_16", "16"}}},
      {"inclination / degrees", false, {{"inclination_surface", "surface"}, {"inclination_mass", "centre of mass"}}},
      {"load of beams",
       false,
       {{"beam_tension", "tension"}, {"beam_compression", "compression"}, {"beam_moment", "moment"}}},
  };
  return panels;
}

bool series_applies(const DataTable& t) { return t.columns[0].name == "t" && t.columns[0].numeric(); }

// A static solve takes no time: a jump of the curves between two rows. The rows after one are marked on the first
// curve.
void mark_static_solves(const DataTable& table, const DataColumn& time, Chart& chart) {
  const DataColumn* solves = table.find("static_solves");
  if (!solves || !solves->numeric() || chart.curves.empty()) return;
  Curve marks{plain("after a static solve"), CurveStyle::points, {}, {}, {}, {}, curve_color(1)};
  for (std::size_t r = 1; r < table.rows(); ++r)
    if (solves->value[r] > solves->value[r - 1])
      marks.x.push_back(time.value[r]), marks.y.push_back(chart.curves[0].y[r]);
  if (!marks.x.empty()) chart.curves.push_back(std::move(marks));
}

Plot series_plot(const DataTable& table) {
  const DataColumn* time = table.find("t");
  if (!time) time = table.find("time");
  if (!time || !time->numeric()) refuse(table, "series", "a series needs a numeric column t");
  Plot plot{{}, true};
  std::vector<std::string> used{time->name};
  const bool seconds = time->name == "time" || table.find("beam_tension");  // a table's own time; grains of triangles
  const auto add_panel = [&](Chart chart) {
    chart.x.title = rich(seconds ? "`t` / s" : "`t` / `T`_{0}");
    chart.height = 96;
    if (!chart.curves.empty()) plot.charts.push_back(std::move(chart));
  };
  const auto add_curve = [&](Chart& chart, const DataColumn& column, RichText label) {
    if (!(chart.y.log ? has_positive(column.value) : has_finite(column.value))) return;
    const bool colour_taken = chart.curves.size() >= kCurves.size();
    const CurveStyle style = column.name.starts_with("imposed") || colour_taken ? CurveStyle::dashed : CurveStyle::line;
    Curve curve{std::move(label), style, time->value, column.value, {}, {}, curve_color(chart.curves.size())};
    chart.curves.push_back(std::move(curve));
  };
  for (const SeriesPanel& panel : series_panels()) {
    Chart chart;
    chart.y = {rich(panel.title), panel.log, {}, {}, false};
    for (const auto& [name, label] : panel.columns)
      if (const DataColumn* column = table.find(name)) {
        used.emplace_back(name);
        if (column->numeric()) add_curve(chart, *column, rich(label));
      }
    if (plot.charts.empty()) mark_static_solves(table, *time, chart);
    add_panel(std::move(chart));
  }
  for (const char* told : {"stage", "static_solves"}) used.emplace_back(told);
  for (const DataColumn& column : table.columns) {
    if (!column.numeric() || std::find(used.begin(), used.end(), column.name) != used.end()) continue;
    Chart chart;
    chart.y.title = plain(column.name);
    add_curve(chart, column, {});
    add_panel(std::move(chart));
  }
  if (plot.charts.empty()) refuse(table, "series", "no numeric column beside the time");
  return plot;
}

// --- bench: log-log, shares with zeros linear; one curve a label ---

bool is_time_column(const DataColumn& c) {
  return c.numeric() && starts_with_any(c.name, {"cpu_seconds", "seconds", "wall_seconds", "time_seconds", "cpu",
                                                 "wall", "ms", "time_s"});
}
bool is_step_column(const DataColumn& c) {
  return c.numeric() && (starts_with_any(c.name, {"dt", "step", "time_step"}) || c.name == "c");
}
bool is_error_column(const DataColumn& c) { return c.numeric() && starts_with_any(c.name, {"error"}); }

bool has_text(const DataTable& t) {
  return std::any_of(t.columns.begin(), t.columns.end(), [](const DataColumn& c) { return !c.numeric(); });
}
bool bench_applies(const DataTable& t) {
  return has_text(t) || std::any_of(t.columns.begin(), t.columns.end(), is_error_column);
}

// Text columns joined, one for each row.
std::vector<std::string> row_labels(const DataTable& table) {
  std::vector<std::string> labels(table.rows());
  for (const DataColumn& c : table.columns)
    if (!c.numeric())
      for (std::size_t r = 0; r < labels.size(); ++r)
        if (!c.text[r].empty()) labels[r] += (labels[r].empty() ? "" : ", ") + c.text[r];
  return labels;
}

// Shares of a whole some of which are zero: a logarithmic axis would drop just the best of them.
bool is_share_with_zeros(const DataColumn& c) {
  bool zero = false;
  for (double v : c.value) {
    if (v < 0 || v > 1) return false;
    zero = zero || v == 0;
  }
  return zero;
}

// Lines join the points of a label in order of x; the points carry the label in the legend.
std::vector<Curve> labelled_curves(const DataTable& table, const DataColumn& x, const DataColumn& y, bool zeros) {
  std::vector<std::string> order;
  std::map<std::string, std::vector<std::pair<double, double>>> by_label;
  const std::vector<std::string> labels = row_labels(table);
  for (std::size_t r = 0; r < table.rows(); ++r) {
    if (!by_label.contains(labels[r])) order.push_back(labels[r]);
    if (x.value[r] > 0 && (y.value[r] > 0 || (zeros && y.value[r] == 0)))
      by_label[labels[r]].emplace_back(x.value[r], y.value[r]);
    else
      by_label[labels[r]];
  }
  std::vector<Curve> curves;
  for (std::size_t k = 0; k < order.size(); ++k) {
    auto& points = by_label[order[k]];
    if (points.empty()) continue;
    std::sort(points.begin(), points.end());
    Curve line{{}, CurveStyle::line, {}, {}, {}, {}, blend(curve_color(k), kWhite, 0.45)};
    for (const auto& [px, py] : points) line.x.push_back(px), line.y.push_back(py);
    Curve marks = line;
    marks.label = plain(order[k]), marks.style = CurveStyle::points, marks.color = curve_color(k);
    curves.push_back(std::move(line));
    curves.push_back(std::move(marks));
  }
  return curves;
}

Plot bench_plot(const DataTable& table) {
  std::vector<const DataColumn*> xs, ys;
  for (const DataColumn& c : table.columns)
    if (is_error_column(c)) ys.push_back(&c);
  if (!ys.empty()) {  // work-precision: error against step and against cost
    for (const DataColumn& c : table.columns)
      if (is_step_column(c) || is_time_column(c)) xs.push_back(&c);
    if (xs.empty())
      refuse(table, "bench", "an error column needs one of the time step (dt...) or of the run time (cpu_seconds...)");
  } else {  // scaling: the rest against the first numbers
    for (const DataColumn& c : table.columns)
      if (c.numeric()) (xs.empty() ? xs : ys).push_back(&c);
    if (ys.empty()) refuse(table, "bench", "needs two numeric columns");
  }
  Plot plot;
  for (const DataColumn* y : ys)
    for (const DataColumn* x : xs) {
      Chart chart;
      chart.x = {plain(x->name), true, {}, {}, false};
      const bool linear = !is_error_column(*y) && is_share_with_zeros(*y);
      chart.y = {plain(y->name), !linear, {}, {}, false};
      chart.height = ys.size() * xs.size() > 2 ? 150 : 230;
      chart.curves = labelled_curves(table, *x, *y, linear);
      if (!chart.curves.empty()) plot.charts.push_back(std::move(chart));
    }
  if (plot.charts.empty()) refuse(table, "bench", "has no positive numbers for logarithmic axes");
  return plot;
}

// --- NT: the contacts of a list as points ---

bool nt_applies(const DataTable& t) {
  const DataColumn *n = t.find("N"), *tangential = t.find("T");
  return n && tangential && n->numeric() && tangential->numeric();
}

Plot nt_plot(const DataTable& table) {
  if (!nt_applies(table)) refuse(table, "NT", "needs numeric columns N and T");
  Chart chart;
  chart.x.title = rich("`N`");
  chart.y.title = rich("`T`");
  chart.height = 380;
  chart.curves.push_back(
      {{}, CurveStyle::cloud, table.find("N")->value, table.find("T")->value, {}, {}, curve_color(0)});
  if (!has_finite(chart.curves[0].x)) refuse(table, "NT", "has no contact with forces");
  return {{chart}, false};
}

}  // namespace

const std::vector<TablePlot>& table_plots() {
  static const std::vector<TablePlot> plots = {
      {"series", series_applies, series_plot}, {"NT", nt_applies, nt_plot}, {"bench", bench_applies, bench_plot}};
  return plots;
}

}  // namespace isostat
