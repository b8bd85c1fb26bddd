// Sections `scattering`, `dacf` and `pores` of `analyze` as charts.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/figure/json_plot_list.hpp"
#include "analysis/figure/json_values.hpp"
#include "analysis/figure/nice_numbers.hpp"
#include "analysis/structure/fractal_fit.hpp"

namespace isostat {
namespace {

using Json = nlohmann::json;

// Eq. 26 in its window; nothing where I(k) is no power law there.
void add_power_law(Chart& chart, const Json* power) {
  if (!power || untold(power)) return;
  const Value d = value_of(find(*power, {"d_F"})), amplitude = value_of(find(*power, {"amplitude"}));
  const Values window = values_of(find(*power, {"window"}));
  if (!std::isfinite(d.mean) || !std::isfinite(amplitude.mean) || window.mean.size() != 2) return;
  Curve line;
  line.style = CurveStyle::dashed;
  line.color = curve_color(2);
  line.label = rich("Eq. 26, `k`^{-`d`}");
  for (const double k : log_steps(window.mean[0], window.mean[1]))
    line.x.push_back(k), line.y.push_back(amplitude.mean * std::pow(k, -d.mean));
  chart.curves.push_back(std::move(line));
  const double error = std::isfinite(d.error) ? d.error : value_of(find(*power, {"d_F_error"})).mean;
  chart.notes.push_back(rich("Eq. 26: `d`_{F} = ") + number_text_with_error(d.mean, error));
}

// --- scattering (Fig. 23) ---

bool scattering_applies(const Json& r) {
  const Json *k = find(r, {"scattering", "k"}), *i = find(r, {"scattering", "I"});
  return k && i && k->is_array() && i->is_array() && !k->empty() && k->size() == i->size();
}

Plot scattering_plot(const Json& r, const std::string& path) {
  if (!scattering_applies(r)) refuse_plot(path, "scattering", "no scattering function; run analyze --only scattering");
  // An ensemble of any sizes: all modes in one curve with its own fit.
  const Json *pooled = find(r, {"scattering", "pooled"}), &s = pooled ? *pooled : r["scattering"];
  const Values intensity = values_of(find(s, {"I"})), sigma = values_of(find(s, {"sigma"}));
  Curve points;
  points.style = CurveStyle::points;
  points.x = values_of(find(s, {"k"})).mean;
  points.y = intensity.mean;
  points.error = intensity.error;  // of an ensemble; else the error within the bin
  for (std::size_t b = 0; b < points.error.size(); ++b)
    if (!std::isfinite(points.error[b]) && b < sigma.mean.size()) points.error[b] = sigma.mean[b];
  double low = INFINITY, high = 0;
  for (std::size_t b = 0; b < points.x.size(); ++b)
    if (points.x[b] > 0 && points.y[b] > 0) low = std::min(low, points.x[b]), high = std::max(high, points.x[b]);
  if (!(high > 0)) refuse_plot(path, "scattering.I", "has no positive value");
  const bool reduced = find(r, {"units", "length"}) != nullptr;
  Chart chart;
  chart.x = {reduced ? rich("`ka`") : rich("`k`"), true, {}, {}, false};
  chart.y = {reduced ? rich("`I`(`k`) / `a`^{2}") : rich("`I`(`k`)"), true, {}, {}, false};
  chart.height = 280;
  points.label = rich("`I`(`k`)");
  chart.curves.push_back(std::move(points));
  if (const auto why = untold(find(s, {"fit"}))) {
    chart.notes.push_back(plain("Eq. 28 not identifiable: " + *why));
    add_power_law(chart, find(s, {"power"}));
    return {{chart}, false};
  }
  const Value d = value_of(find(s, {"fit", "d_F"})), xi = value_of(find(s, {"fit", "xi"})),
              amplitude = value_of(find(s, {"fit", "amplitude"})), constant = value_of(find(s, {"fit", "constant"}));
  if (std::isfinite(d.mean) && std::isfinite(xi.mean) && std::isfinite(amplitude.mean)) {
    Curve fit;
    fit.label = rich("fit, Eq. 28");
    fit.color = curve_color(1);
    constexpr int kPoints = 200;
    for (int p = 0; p <= kPoints; ++p) {
      const double k = low * std::pow(high / low, static_cast<double>(p) / kPoints);
      fit.x.push_back(k);
      fit.y.push_back(
          fractal_intensity(k, d.mean, xi.mean, amplitude.mean, std::isfinite(constant.mean) ? constant.mean : 0));
    }
    chart.curves.push_back(std::move(fit));
    const auto error = [&](const Value& v, const char* key) {
      const double sampled = value_of(find(s, {"fit", "bootstrap", key})).mean;  // over samples, where there are some
      return std::isfinite(sampled) ? sampled : std::isfinite(v.error) ? v.error : value_of(find(s, {"fit", key})).mean;
    };
    chart.notes.push_back(rich("`d`_{F} = ") + number_text_with_error(d.mean, error(d, "d_F_error")));
    chart.notes.push_back(rich(reduced ? "`ξ` / `a` = " : "`ξ` = ") +
                          number_text_with_error(xi.mean, error(xi, "xi_error")));
  }
  add_power_law(chart, find(s, {"power"}));
  return {{chart}, false};
}

// --- correlation: C(r) - Phi^2 and Eq. 27, local dimension of the mass-radius relation ---

bool correlation_applies(const Json& r) {
  const Json *at = find(r, {"dacf", "r"}), *c = find(r, {"dacf", "C"});
  return at && c && at->is_array() && c->is_array() && !at->empty() && at->size() == c->size();
}

Plot correlation_plot(const Json& r, const std::string& path) {
  if (!correlation_applies(r)) refuse_plot(path, "dacf", "no density autocorrelation; run analyze --only dacf");
  const Json& s = r["dacf"];
  const Json* pooled = find(s, {"pooled"});
  const double phi = value_of(find(s, {"solid_fraction"})).mean;
  Curve points;
  points.style = CurveStyle::points;
  points.label = rich("`C`(`r`) - `Φ`^{2}");
  points.x = values_of(find(pooled ? *pooled : s, {"r"})).mean;
  points.y = values_of(find(pooled ? *pooled : s, {pooled ? "excess" : "C"})).mean;
  if (!pooled)
    for (double& c : points.y) c -= phi * phi;
  const bool reduced = find(r, {"units", "length"}) != nullptr;
  const RichText distance = reduced ? rich("`r` / `a`") : rich("`r`");
  Chart chart;
  chart.x = {distance, true, {}, {}, false};
  chart.y = {rich("`C`(`r`) - `Φ`^{2}"), true, {}, {}, false};
  chart.height = 240;
  chart.curves.push_back(std::move(points));
  const auto& y = chart.curves[0].y;
  if (std::none_of(y.begin() + 1, y.end(), [](double v) { return v > 0; }))
    refuse_plot(path, "dacf.C", "has no positive excess over the square of the solid fraction");
  const Json* fit = find(pooled ? *pooled : s, {"fit"});
  if (const auto why = untold(fit)) {
    chart.notes.push_back(plain("Eq. 27 not identifiable: " + *why));
  } else if (fit) {
    const auto of = [&](const char* key) { return value_of(find(*fit, {key})); };
    const Value d = of("d_F"), xi = of("xi"), amplitude = of("amplitude");
    const Values window = values_of(find(*fit, {"window"}));
    if (std::isfinite(d.mean) && std::isfinite(xi.mean) && window.mean.size() == 2) {
      Curve curve;
      curve.label = rich("fit, Eq. 27");
      curve.color = curve_color(1);
      for (const double at : log_steps(window.mean[0], window.mean[1]))
        curve.x.push_back(at), curve.y.push_back(fractal_correlation(at, d.mean, xi.mean, amplitude.mean));
      chart.curves.push_back(std::move(curve));
      const auto error = [&](const Value& v, const char* key) {
        const double sampled = value_of(find(*fit, {"bootstrap", key})).mean;
        return std::isfinite(sampled) ? sampled : std::isfinite(v.error) ? v.error : of(key).mean;
      };
      chart.notes.push_back(rich("`d`_{F} = ") + number_text_with_error(d.mean, error(d, "d_F_error")));
      chart.notes.push_back(rich(reduced ? "`ξ` / `a` = " : "`ξ` = ") +
                            number_text_with_error(xi.mean, error(xi, "xi_error")));
    }
  }
  Chart local;
  local.x = {distance, true, {}, {}, false};
  local.y = {rich("d ln `M` / d ln `r`"), false, {}, {}, false};
  local.height = 150;
  Curve slope;
  slope.color = curve_color(2);
  slope.x = values_of(find(s, {"r"})).mean;
  slope.y = values_of(find(s, {"mass_radius", "local_dimension"})).mean;
  local.curves.push_back(std::move(slope));
  if (local.curves[0].y.size() != local.curves[0].x.size()) return {{chart}, false};
  return {{chart, local}, true};
}

// --- pores: how many are larger than R ---

bool pores_applies(const Json& r) {
  const Json* list = find(r, {"pores", "list"});
  return list && list->is_array() && !list->empty();
}

// Entries are pores, or in an ensemble lists of pores.
void collect_radii(const Json& list, std::vector<double>& radii) {
  for (const Json& entry : list) {
    if (entry.is_array())
      collect_radii(entry, radii);
    else if (const double radius = value_of(find(entry, {"R"})).mean; radius > 0)
      radii.push_back(radius);
  }
}

Plot pores_plot(const Json& r, const std::string& path) {
  std::vector<double> radii;
  if (pores_applies(r)) collect_radii(r["pores"]["list"], radii);
  if (radii.empty()) refuse_plot(path, "pores.list", "has no finite pore with a radius; run analyze --only pores");
  std::sort(radii.begin(), radii.end());
  Curve curve = number_above(radii);
  const bool reduced = find(r, {"units", "length"}) != nullptr;
  Chart chart;
  chart.x = {reduced ? rich("equivalent radius `R` / `a`") : rich("equivalent radius `R`"), true, {}, {}, false};
  chart.y = {rich("number of pores larger than `R`"), true, {}, {}, false};
  chart.curves.push_back(std::move(curve));
  add_size_law(chart, find(r, {"pores", "size_law"}), radii, rich("`R`"));
  const Value mean = value_of(find(r, {"pores", "mean_radius_weighted"}));
  if (std::isfinite(mean.mean))
    chart.notes.push_back(rich(reduced ? "⟨`R`⟩_{w} / `a` = " : "⟨`R`⟩_{w} = ") +
                          number_text_with_error(mean.mean, mean.error));
  return {{chart}, false};
}

}  // namespace

const std::vector<JsonPlot>& structure_plots() {
  static const std::vector<JsonPlot> plots = {{"scattering", scattering_applies, scattering_plot},
                                              {"correlation", correlation_applies, correlation_plot},
                                              {"pores", pores_applies, pores_plot}};
  return plots;
}

}  // namespace isostat
