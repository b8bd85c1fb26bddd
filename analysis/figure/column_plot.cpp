#include "analysis/figure/column_plot.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <string_view>

#include "dem/input_error.hpp"

namespace isostat {
namespace {

constexpr std::size_t kManyRows = 60;  // points of more would hide each other

// Reduced units of disks and spheres (docs/formats.md).
const std::map<std::string_view, const char*>& titles() {
  static const std::map<std::string_view, const char*> known{
      {"t", "`t` / `T`_{0}"},
      {"Phi", "Φ"},
      {"L1", "`L`_{1} / `a`"},
      {"L2", "`L`_{2} / `a`"},
      {"L3", "`L`_{3} / `a`"},
      {"strain1", "strain, direction 1"},
      {"strain2", "strain, direction 2"},
      {"strain3", "strain, direction 3"},
      {"sigma11", "`σ`_{11} / (`F`_{0}/`a`)"},
      {"sigma22", "`σ`_{22} / (`F`_{0}/`a`)"},
      {"sigma33", "`σ`_{33} / (`F`_{0}/`a`²)"},
      {"sigma12", "`σ`_{12} / (`F`_{0}/`a`)"},
      {"z", "`z`"},
  };
  return known;
}

// Columns of a study. Stresses have no unit here: it is F0/a in the plane and F0/a^2 in space.
const std::map<std::string_view, const char*>& titles_of_studies() {
  static const std::map<std::string_view, const char*> known{
      {"counts.solid_fraction", "Φ"},
      {"counts.z", "`z`"},
      {"counts.z_star", "`z`*"},
      {"stage.pressure", "`P`*"},
      {"law.friction", "μ"},
      {"grains.solid_fraction", "Φ_{I}"},
      {"rigidity.H", "`H`"},
      {"rigidity.K", "`K`"},
      {"moduli.bulk", "bulk modulus `K`"},
      {"moduli.shear", "shear modulus `G`"},
      {"pores.mean_radius_weighted", "mean pore radius / `a`"},
      {"e", "void ratio `e`"},
  };
  return known;
}

Curve curve_of(const DataTable& table, const DataColumn& x, const DataColumn& y) {
  const DataColumn* error = table.find(y.name + "_se");
  if (error && !error->numeric()) error = nullptr;
  Curve curve;
  for (std::size_t r = 0; r < table.rows(); ++r) {
    if (!std::isfinite(x.value[r]) || !std::isfinite(y.value[r])) continue;
    curve.x.push_back(x.value[r]), curve.y.push_back(y.value[r]);
    if (error) curve.error.push_back(std::isfinite(error->value[r]) ? error->value[r] : 0);
  }
  if (curve.x.empty()) throw InputError(table.path, 0, "--y", y.name, "no row has a number here and in " + x.name);
  return curve;
}

}  // namespace

RichText column_title(const DataTable& table, const std::string& name) {
  const bool series = table.columns[0].name == "t" && table.find("kinetic_energy") && !table.find("beam_tension");
  const bool study = table.columns[0].name == "row" && table.find("runs");
  const auto& known = study ? titles_of_studies() : titles();
  const auto found = known.find(name);
  return (series || study) && found != known.end() ? rich(found->second) : plain(name);
}

Plot column_plot(const std::vector<DataTable>& tables, const std::string& x_name,
                 const std::vector<std::string>& y_names) {
  Chart chart;
  chart.x.title = column_title(tables[0], column_named(tables[0], "--x", x_name).name);
  for (const std::string& name : y_names)
    chart.y.title = chart.y.title + (chart.y.title.empty() ? RichText{} : plain(", ")) +
                    column_title(tables[0], column_named(tables[0], "--y", name).name);
  std::size_t color = 0;
  for (const DataTable& table : tables)
    for (const std::string& name : y_names) {
      const DataColumn &x = column_named(table, "--x", x_name), &y = column_named(table, "--y", name);
      Curve curve = curve_of(table, x, y);
      curve.color = curve_color(color++);
      RichText label;
      if (tables.size() > 1) label = plain(std::filesystem::path(table.path).stem().string());
      if (y_names.size() > 1) label = label + (label.empty() ? RichText{} : plain(", ")) + column_title(table, y.name);
      if (curve.x.size() <= kManyRows) {
        Curve line{{}, CurveStyle::line, curve.x, curve.y, {}, {}, blend(curve.color, kWhite, 0.45)};
        chart.curves.push_back(std::move(line));
        curve.style = CurveStyle::points;
      } else {
        curve.error.clear();
      }
      curve.label = label;
      chart.curves.push_back(std::move(curve));
    }
  return {{chart}, false};
}

}  // namespace isostat
