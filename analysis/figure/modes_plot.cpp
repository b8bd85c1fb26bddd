// Section `modes` of `analyze` as a chart: the density of states of all modes, by the kernel polynomial method, or
// both.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/figure/json_plot_list.hpp"
#include "analysis/figure/json_values.hpp"
#include "analysis/figure/nice_numbers.hpp"

namespace isostat {
namespace {

using Json = nlohmann::json;

const Json* estimate(const Json& r) {
  const Json* h = find(r, {"modes", "density", "histogram"});
  return is_histogram(h) ? h : nullptr;
}

double number(const Json& r, const char* key) { return value_of(find(r, {"modes", key})).mean; }

// Frequencies above zero, ascending, if the section has all of them; else none.
std::vector<double> all_modes(const Json& r) {
  std::vector<double> omega = values_of(find(r, {"modes", "omega"})).mean;
  const double zero = number(r, "zero_modes"), dofs = number(r, "degrees_of_freedom");
  if (omega.empty() || static_cast<double>(omega.size()) + zero != dofs) return {};
  std::erase_if(omega, [](double w) { return !(w > 0); });
  std::sort(omega.begin(), omega.end());
  return omega;
}

bool density_applies(const Json& r) { return estimate(r) || !all_modes(r).empty(); }

// Bins from 0 on: those of the estimate, or some root of their number.
std::vector<double> edges_for(const std::vector<double>& omega) {
  const double bins = std::max(10.0, 2 * std::sqrt(static_cast<double>(omega.size()))),
               width = nice_above(omega.back() / bins);
  std::vector<double> edges{0};
  while (edges.back() < omega.back()) edges.push_back(static_cast<double>(edges.size()) * width);
  return edges;
}

double count_below(const std::vector<double>& sorted, double to) {
  return static_cast<double>(std::upper_bound(sorted.begin(), sorted.end(), to) - sorted.begin());
}

// Points in the middle of the bins above zero that stand out of their errors: others have no place on a logarithmic
// axis.
Curve at_middles(const std::vector<double>& edges, const std::vector<double>& density, const std::vector<double>& error,
                 const std::vector<double>& kernel) {
  Curve curve;
  const auto hides = [&](const std::vector<double>& of, std::size_t k) { return k < of.size() && density[k] < of[k]; };
  for (std::size_t k = 0; k + 1 < edges.size(); ++k) {
    if (!(edges[k] >= 0) || !(density[k] > 0) || hides(error, k) || hides(kernel, k)) continue;
    curve.x.push_back((edges[k] + edges[k + 1]) / 2), curve.y.push_back(density[k]);
    if (k < error.size()) curve.error.push_back(error[k]);
  }
  return curve;
}

Plot density_plot(const Json& r, const std::string& path) {
  if (!density_applies(r))
    refuse_plot(path, "modes", "neither all modes nor their density; run analyze --only modes --density-of-states 100");
  Chart density, below;
  std::vector<double> edges;
  if (const Json* h = estimate(r)) {
    const Values values = values_of(find(*h, {"density"})), own = values_of(find(*h, {"error"})),
                 counts = values_of(find(*h, {"below"}));
    edges = values_of(find(*h, {"edges"})).mean;
    const bool ensemble = std::any_of(values.error.begin(), values.error.end(), [](double e) { return e > 0; });
    Curve points =
        at_middles(edges, values.mean, ensemble ? values.error : own.mean, values_of(find(*h, {"kernel_error"})).mean);
    points.style = CurveStyle::points;
    points.label = rich("kernel polynomials");
    density.curves.push_back(std::move(points));
    Curve sum;
    sum.label = rich("kernel polynomials");
    const double zero = number(r, "zero_modes");
    for (std::size_t k = 0; k < counts.mean.size(); ++k)
      if (edges[k + 1] > 0 && counts.mean[k] > zero)
        sum.x.push_back(edges[k + 1]), sum.y.push_back(counts.mean[k] - zero);
    below.curves.push_back(std::move(sum));
    const Value resolution = value_of(find(r, {"modes", "density", "resolution"}));
    density.notes.push_back(rich("resolution at `ω` = 0: ") + number_text(resolution.mean, 2));
  }
  if (const std::vector<double> omega = all_modes(r); !omega.empty()) {
    if (edges.empty()) edges = edges_for(omega);
    std::vector<double> exact;
    for (std::size_t k = 0; k + 1 < edges.size(); ++k)
      exact.push_back((count_below(omega, edges[k + 1]) - count_below(omega, edges[k])) / (edges[k + 1] - edges[k]));
    Curve line = at_middles(edges, exact, {}, {});
    line.label = rich("all modes");
    line.color = curve_color(1);
    density.curves.push_back(std::move(line));
    Curve steps;
    steps.label = rich("all modes");
    steps.color = curve_color(1);
    for (std::size_t k = 0; k < omega.size(); ++k) {
      const double before = std::max(static_cast<double>(k), 0.5);  // a step up from below the axis
      steps.x.insert(steps.x.end(), {omega[k], omega[k]});
      steps.y.insert(steps.y.end(), {before, static_cast<double>(k) + 1});
    }
    below.curves.push_back(std::move(steps));
  }
  if (std::all_of(density.curves.begin(), density.curves.end(), [](const Curve& c) { return c.x.empty(); }))
    refuse_plot(path, "modes.density", "has no bin that stands out of its error");
  density.x = {rich("`ω`"), true, {}, {}, false};
  density.y = {rich("modes in d`ω`, `D`(`ω`)"), true, {}, {}, false};
  below.x = density.x;
  below.y = {rich("modes in (0, `ω`)"), true, {}, {}, false};
  below.height = 170;
  return {{std::move(density), std::move(below)}, true};
}

}  // namespace

const std::vector<JsonPlot>& modes_plots() {
  static const std::vector<JsonPlot> plots = {{"density-of-states", density_applies, density_plot}};
  return plots;
}

}  // namespace isostat
