// Sections `stressed`, `loops` and `two_contacts` of `analyze` as charts.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/figure/json_plot_list.hpp"
#include "analysis/figure/json_values.hpp"
#include "analysis/figure/nice_numbers.hpp"

namespace isostat {
namespace {

using Json = nlohmann::json;

// --- stressed: clusters of at least n grains ---

bool stressed_applies(const Json& r) {
  const Json* list = find(r, {"stressed", "list"});
  return list && list->is_array() && !list->empty();
}

// Entries are clusters, or in an ensemble lists of clusters; spanning ones have no size of their own.
void collect_sizes(const Json& list, std::vector<double>& sizes) {
  for (const Json& entry : list) {
    if (entry.is_array())
      collect_sizes(entry, sizes);
    else if (const Json* spans = find(entry, {"spans"}); !spans || *spans == "")
      if (const double n = value_of(find(entry, {"grains"})).mean; n > 0) sizes.push_back(n);
  }
}

Plot stressed_plot(const Json& r, const std::string& path) {
  std::vector<double> sizes;
  if (stressed_applies(r)) collect_sizes(r["stressed"]["list"], sizes);
  if (sizes.empty())
    refuse_plot(path, "stressed.list", "has no cluster that does not span; run analyze --only stressed");
  std::sort(sizes.begin(), sizes.end());
  Plot plot;
  Chart chart;
  chart.x = {rich("grains `n`"), true, {}, {}, false};
  chart.y = {rich("clusters of at least `n` grains"), true, {}, {}, false};
  chart.curves.push_back(number_above(sizes));
  add_size_law(chart, find(r, {"stressed", "size_law"}), sizes, rich("`n`"));
  const Value threshold = value_of(find(r, {"stressed", "threshold"}));
  if (std::isfinite(threshold.mean))
    chart.notes.push_back(rich("forces from ") + number_text(threshold.mean) + plain(" ") + force_unit(r));
  plot.charts.push_back(std::move(chart));
  const Values above = values_of(find(r, {"stressed", "above"})),
               size = values_of(find(r, {"stressed", "above_largest"})),
               weighted = values_of(find(r, {"stressed", "above_mean_size_weighted"}));
  if (above.mean.size() > 1 && size.mean.size() == above.mean.size() && weighted.mean.size() == above.mean.size()) {
    Chart scan;
    scan.x = {over(rich("threshold"), force_unit(r)), true, {}, {}, false};
    scan.y = {rich("grains"), true, {}, {}, false};
    scan.height = 170;
    Curve largest, mean;
    largest.label = plain("largest cluster"), mean.label = plain("cluster of a grain, mean");
    largest.x = mean.x = above.mean;
    largest.y = size.mean, mean.y = weighted.mean;
    mean.color = curve_color(1);
    scan.curves = {std::move(largest), std::move(mean)};
    plot.charts.push_back(std::move(scan));
  }
  return plot;
}

// --- histograms of logarithms: forces of trees, loops and clusters; deviation from Eq. 20 ---

using Named = std::pair<const char*, const char*>;  // histogram, label
Chart log_histograms(const Json* histograms, std::initializer_list<Named> names, RichText title) {
  Chart chart;
  chart.x.title = std::move(title);
  chart.y = {rich("probability density"), false, {}, {}, false};
  for (const auto& [name, label] : names) {
    const Json* h = histograms ? find(*histograms, {name}) : nullptr;
    if (!is_histogram(h)) continue;
    Curve curve = trimmed(steps(*h));
    curve.label = plain(label);
    curve.color = curve_color(chart.curves.size());
    chart.curves.push_back(std::move(curve));
  }
  return chart;
}

bool loops_applies(const Json& r) { return is_histogram(find(r, {"loops", "histograms", "log10_F_loops"})); }

Plot loops_plot(const Json& r, const std::string& path) {
  if (!loops_applies(r)) refuse_plot(path, "loops.histograms", "no forces of loops; run analyze --only loops");
  Chart chart = log_histograms(
      find(r, {"loops", "histograms"}),
      {{"log10_F_loops", "loops, by moments"}, {"log10_F_clusters", "clusters"}, {"log10_F_trees", "trees"}},
      rich("log_{10}(|`F`| / `F`_{1})"));
  const Value scale = value_of(find(r, {"loops", "scale"})), median = value_of(find(r, {"loops", "loops", "median"}));
  if (std::isfinite(scale.mean)) chart.notes.push_back(rich("`μ`_{r}`F`_{0}/`a` = ") + number_text(scale.mean));
  if (std::isfinite(median.mean))
    chart.notes.push_back(plain("median of loops ") + number_text_with_error(median.mean, median.error));
  return {{chart}, false};
}

bool two_contacts_applies(const Json& r) {
  const Json* h = find(r, {"two_contacts", "histograms"});
  return h && h->is_object() && !h->empty();
}

Plot two_contacts_plot(const Json& r, const std::string& path) {
  Chart chart;
  if (two_contacts_applies(r))
    chart = log_histograms(find(r, {"two_contacts", "histograms"}),
                           {{"log10_deviation_touching", "neighbours touch: Eq. 20"},
                            {"log10_deviation_apart", "neighbours apart: cot γ/2"}},
                           rich("log_{10} of the relative deviation of |`T`/`N`|"));
  if (chart.curves.empty())
    refuse_plot(path, "two_contacts", "no grain with two contacts; run analyze --only two_contacts");
  return {{chart}, false};
}

}  // namespace

const std::vector<JsonPlot>& network_plots() {
  static const std::vector<JsonPlot> plots = {{"stressed", stressed_applies, stressed_plot},
                                              {"loops", loops_applies, loops_plot},
                                              {"two-contacts", two_contacts_applies, two_contacts_plot}};
  return plots;
}

}  // namespace isostat
