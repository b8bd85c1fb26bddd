// Sections of `analyze` and results of `lab` as charts.
#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "analysis/figure/json_plot_list.hpp"
#include "analysis/figure/json_values.hpp"
#include "analysis/figure/nice_numbers.hpp"
#include "analysis/figure/plot.hpp"
#include "dem/input_error.hpp"

namespace isostat {
namespace {

using Json = nlohmann::json;

// --- histograms of forces ---

bool force_histogram_applies(const Json& r) { return is_histogram(find(r, {"forces", "histograms", "N"})); }

Plot force_histogram_plot(const Json& r, const std::string& path) {
  const Json* n = find(r, {"forces", "histograms", "N"});
  if (!is_histogram(n))
    refuse_plot(path, "forces.histograms.N", "no histogram of normal forces; run analyze --only forces");
  const RichText unit = force_unit(r);
  Plot plot;
  Chart chart;
  chart.x.title = over(rich("`N`"), unit);
  chart.y = {rich("probability density"), true, {}, {}, false};
  chart.curves.push_back(trimmed(steps(*n)));
  plot.charts.push_back(std::move(chart));
  if (const Json* total = find(r, {"forces", "histograms", "F"}); is_histogram(total)) {
    Chart log;  // bins are decades: only they show the divergence at small forces
    log.x = {over(rich("|`F`|"), unit), true, {}, {}, false};
    log.y = {rich("probability density"), true, {}, {}, false};
    log.curves.push_back(trimmed(steps(*total)));
    log.curves[0].color = curve_color(2);
    if (std::any_of(log.curves[0].y.begin(), log.curves[0].y.end(), [](double d) { return d > 0; }))
      plot.charts.push_back(std::move(log));
  }
  return plot;
}

bool angle_applies(const Json& r) { return is_histogram(find(r, {"forces", "histograms", "angle"})); }

Plot angle_plot(const Json& r, const std::string& path) {
  const Json* angle = find(r, {"forces", "histograms", "angle"});
  if (!is_histogram(angle))
    refuse_plot(path, "forces.histograms.angle", "no histogram of angles; run analyze --only forces");
  Chart chart;
  chart.x.title = rich("angle between force and normal, `θ` (degrees)");
  chart.y.title = rich("probability density (1/degree)");
  chart.curves.push_back(steps(*angle));
  return {{chart}, false};
}

bool nt_applies(const Json& r) {
  const Json *edges = find(r, {"forces", "histograms", "NT", "edges"}),
             *density = find(r, {"forces", "histograms", "NT", "density"});
  return edges && density && edges->is_array() && edges->size() == 2 && density->is_array() && !density->empty();
}

Plot nt_plot(const Json& r, const std::string& path) {
  if (!nt_applies(r)) refuse_plot(path, "forces.histograms.NT", "no pairs of forces; run analyze --only forces");
  const Json& nt = *find(r, {"forces", "histograms", "NT"});
  Curve cells;
  cells.style = CurveStyle::cells;
  cells.x = values_of(&nt["edges"][0]).mean;
  cells.x2 = values_of(&nt["edges"][1]).mean;
  for (const Json& row : nt["density"])
    for (const double d : values_of(&row).mean) cells.y.push_back(d);
  if (cells.x.size() < 2 || cells.x2.size() < 2 || cells.y.size() != (cells.x.size() - 1) * (cells.x2.size() - 1))
    refuse_plot(path, "forces.histograms.NT", "edges and density do not fit each other");
  Chart chart;
  chart.x.title = over(rich("`N`"), force_unit(r));
  chart.y.title = over(rich("`T`"), force_unit(r));
  chart.equal_units = true;
  chart.curves.push_back(std::move(cells));
  return {{chart}, false};
}

// --- coordination numbers (Figs. 3, 6) ---

bool coordination_applies(const Json& r) {
  const Json* x = find(r, {"counts", "x"});
  return x && x->is_array() && !x->empty();
}

Plot coordination_plot(const Json& r, const std::string& path) {
  if (!coordination_applies(r)) refuse_plot(path, "counts.x", "no coordination numbers; run analyze --only counts");
  const Values x = values_of(find(r, {"counts", "x"}));
  Curve bars;
  bars.style = CurveStyle::bars;
  for (std::size_t k = 0; k < x.mean.size(); ++k) {
    bars.x.push_back(static_cast<double>(k));
    bars.y.push_back(100 * x.mean[k]), bars.error.push_back(100 * x.error[k]);
  }
  if (std::none_of(bars.y.begin(), bars.y.end(), [](double v) { return std::isfinite(v); }))
    refuse_plot(path, "counts.x", "is undefined: every grain is a rattler");
  Chart chart;
  chart.x.title = rich("number of interacting neighbours `k`");
  chart.x.whole = true;
  chart.y.title = rich("`x_{k}`  (% of the grains)");
  const Value z = value_of(find(r, {"counts", "z"}));
  if (std::isfinite(z.mean)) chart.notes.push_back(rich("`z` = ") + number_text_with_error(z.mean, z.error));
  chart.curves.push_back(std::move(bars));
  return {{chart}, false};
}

// --- law-fit: the measured laws of a soft-particle and Eqs. 7, 8 of its paper (Figs. 3 to 6) ---

bool law_fit_applies(const Json& r) {
  const Json* normal = find(r, {"normal"});
  return normal && normal->is_array() && !normal->empty() && find(normal->front(), {"delta"}) &&
         find(normal->front(), {"F"});
}

Curve measured(const Json& list, const char* value, const char* error) {
  Curve curve;
  curve.style = CurveStyle::points;
  for (const Json& entry : list) {
    const Value v = value_of(find(entry, {value}));
    curve.x.push_back(value_of(find(entry, {"delta"})).mean);
    curve.y.push_back(v.mean);
    curve.error.push_back(std::isfinite(v.error) ? v.error : value_of(find(entry, {error})).mean);
  }
  return curve;
}

// max(0, a x^b + c) up to `high`, with its parameters as notes; nothing without a fit.
void add_fit(Chart& chart, const Json& r, const char* fit, double high, const RichText& quantity, const char* unit) {
  const auto parameter = [&](const char* key) { return value_of(find(r, {fit, key})).mean; };
  const auto with_error = [&](const char* key, const char* error) {
    return number_text_with_error(parameter(key), parameter(error));
  };
  const double a = parameter("a"), b = parameter("b"), c = parameter("c"), delta = parameter("delta");
  if (!std::isfinite(a) || !std::isfinite(b) || !std::isfinite(c)) return;
  Curve curve;
  curve.color = curve_color(1);
  curve.label = quantity + rich(" = `a` Δ^{`b`} + `c`");
  constexpr int kPoints = 240;
  for (int p = 0; p <= kPoints; ++p) {
    const double d = high * p / kPoints;
    curve.x.push_back(d);
    curve.y.push_back(std::isfinite(delta) && d < delta ? 0 : a * std::pow(d, b) + c);
  }
  chart.curves.push_back(std::move(curve));
  chart.notes.push_back(rich("`a` = ") + with_error("a", "a_error") + plain(unit) + rich(",  `b` = ") +
                        with_error("b", "b_error"));
  if (std::isfinite(delta)) chart.notes.push_back(rich("`δ` = ") + with_error("delta", "delta_error"));
}

// Hertz's law through its value at the last deformation; nothing without one.
void add_solid(Chart& chart, const Json& last) {
  const double force = value_of(find(last, {"solid"})).mean, high = value_of(find(last, {"delta"})).mean;
  if (!std::isfinite(force)) return;
  Curve curve;
  curve.style = CurveStyle::dashed;
  curve.color = curve_color(2);
  curve.label = rich("solid, Hertz");
  constexpr int kPoints = 60;
  for (int p = 0; p <= kPoints; ++p) {
    const double part = static_cast<double>(p) / kPoints;
    curve.x.push_back(part * high), curve.y.push_back(force * std::pow(part, 1.5));
  }
  chart.curves.push_back(std::move(curve));
}

// Forces against the way of the surface, a curve for each deformation.
Chart turned_chart(const Json& list, const char* value, const char* error, RichText title, double height, bool labels) {
  Chart chart;
  chart.x.title = rich("tangential deformation `h`_{t} (mm)");
  chart.y.title = std::move(title);
  chart.height = height;
  std::vector<double> deltas;
  for (const Json& entry : list) {
    const double delta = value_of(find(entry, {"delta"})).mean;
    if (deltas.empty() || deltas.back() != delta) {
      Curve curve;
      curve.style = CurveStyle::points;
      curve.color = curve_color(deltas.size());
      if (labels) curve.label = rich("Δ_{n} = ") + number_text(delta);
      chart.curves.push_back(std::move(curve));
      deltas.push_back(delta);
    }
    Curve& curve = chart.curves.back();
    curve.x.push_back(1e3 * value_of(find(entry, {"h_t"})).mean);
    curve.y.push_back(value_of(find(entry, {value})).mean);
    curve.error.push_back(value_of(find(entry, {error})).mean);
  }
  return chart;
}

bool any_finite(const std::vector<double>& values) {
  return std::any_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

Plot law_fit_plot(const Json& r, const std::string& path) {
  if (!law_fit_applies(r)) refuse_plot(path, "normal", "no measured law; run lab soft-particle --json");
  Plot plot{{}, true};
  const Json &normal = r["normal"], *tangential = find(r, {"tangential"}), *turned = find(r, {"turned"});
  const bool both = tangential && tangential->is_array() && !tangential->empty();
  Chart chart;
  chart.x.title = rich("normal deformation Δ_{n} = `h`_{n} / `R`_{s}");
  chart.y.title = rich("`F` (N)");
  chart.height = both ? 210 : 270;
  chart.curves.push_back(measured(normal, "F", "F_error"));
  chart.curves[0].label = rich("measured");
  const auto& x = chart.curves[0].x;
  const double high = *std::max_element(x.begin(), x.end());
  add_fit(chart, r, "fit", high, rich("`F`"), " N");
  add_solid(chart, normal.back());
  plot.charts.push_back(std::move(chart));
  if (both) {
    Chart slope;
    slope.x.title = plot.charts[0].x.title;
    slope.y.title = rich("`k`_{t} (N / degree)");
    slope.height = 170;
    slope.curves.push_back(measured(*tangential, "k_t", "k_t_error"));
    slope.curves[0].color = curve_color(2);
    if (any_finite(slope.curves[0].y)) {
      add_fit(slope, r, "tangential_fit", high, rich("`k`_{t}"), " N / degree");
      plot.charts.push_back(std::move(slope));
    }
  }
  if (turned && turned->is_array() && !turned->empty()) {
    plot.share_x = false;
    plot.charts.push_back(turned_chart(*turned, "along", "along_error", rich("`F`_{t} along (N)"), 190, true));
    plot.charts.push_back(
        turned_chart(*turned, "perpendicular", "perpendicular_error", rich("across (N)"), 110, false));
  }
  return plot;
}

}  // namespace

const std::vector<JsonPlot>& json_plots() {
  static const std::vector<JsonPlot> plots = [] {
    std::vector<JsonPlot> all = {{"force-histogram", force_histogram_applies, force_histogram_plot},
                                 {"angle", angle_applies, angle_plot},
                                 {"NT", nt_applies, nt_plot},
                                 {"coordination", coordination_applies, coordination_plot}};
    for (const auto* list : {&structure_plots(), &network_plots(), &modes_plots()})
      all.insert(all.end(), list->begin(), list->end());
    all.push_back({"law-fit", law_fit_applies, law_fit_plot});
    return all;
  }();
  return plots;
}

}  // namespace isostat
