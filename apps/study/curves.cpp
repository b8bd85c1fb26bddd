#include "apps/study/curves.hpp"

#include <cmath>
#include <cstdint>
#include <map>
#include <string>

namespace isostat {

std::vector<CurvePoint> curve_of_sample(const SeriesCurve& curve, const DataTable& series) {
  std::map<std::string, const DataColumn*> columns;
  for (const Expression* of : {&curve.x, &curve.y})
    for (const std::string& name : of->names()) columns[name] = &column_named(series, "curve", name);
  const auto at_row = [&columns](std::size_t row) {
    return [&columns, row](const std::string& name) { return columns.at(name)->value[row]; };
  };
  const DataColumn& stage = column_named(series, "curve.stage", "stage");
  struct Bin {
    double sum = 0;
    std::size_t n = 0;
  };
  std::map<std::int64_t, Bin> bins;
  for (std::size_t row = 0; row < series.rows(); ++row) {
    if (stage.value[row] != static_cast<double>(curve.stage)) continue;
    const double x = curve.x.evaluate(at_row(row)) / curve.step, y = curve.y.evaluate(at_row(row));
    if (!(std::abs(x) < 1e15) || !std::isfinite(y)) continue;
    Bin& bin = bins[static_cast<std::int64_t>(std::floor(x))];
    bin.sum += y, ++bin.n;
  }
  std::vector<CurvePoint> points;
  for (const auto& [k, bin] : bins)
    points.push_back({(static_cast<double>(k) + 0.5) * curve.step, bin.sum / static_cast<double>(bin.n)});
  return points;
}

}  // namespace isostat
