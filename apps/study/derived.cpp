#include "apps/study/derived.hpp"

#include <cmath>

namespace isostat {
namespace {

double value_in(const SampleNumbers& numbers, const std::string& name) {
  const auto found = numbers.find(name);
  return found == numbers.end() ? NAN : found->second;
}

double evaluate(const Expression& expression, const SampleNumbers& numbers) {
  return expression.evaluate([&](const std::string& name) { return value_in(numbers, name); });
}

}  // namespace

void add_derived(const std::vector<DerivedColumn>& columns, SampleNumbers& numbers) {
  for (const DerivedColumn& c : columns) numbers[c.name] = evaluate(c.of, numbers);
}

double slope_of(const PathSlope& slope, const std::vector<const SampleNumbers*>& stages) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  std::vector<std::pair<double, double>> points;
  for (const SampleNumbers* numbers : stages) {
    const double px = evaluate(slope.x, *numbers), py = evaluate(slope.y, *numbers);
    if (std::isfinite(px) && std::isfinite(py)) points.emplace_back(px, py), ++n, x += px, y += py;
  }
  for (const auto& [px, py] : points) xx += (px - x / n) * (px - x / n), xy += (px - x / n) * (py - y / n);
  return n > 1 && xx > 0 ? xy / xx : NAN;
}

Statistic statistic(const std::vector<double>& values) {
  Statistic s;
  double sum = 0, squares = 0;
  for (const double v : values)
    if (std::isfinite(v)) ++s.n, sum += v;
  const double n = static_cast<double>(s.n);
  s.mean = sum / n;
  for (const double v : values)
    if (std::isfinite(v)) squares += (v - s.mean) * (v - s.mean);
  s.sd = std::sqrt(squares / (n - 1));
  s.se = s.sd / std::sqrt(n);
  if (s.n < 2) s.sd = s.se = NAN;
  return s;
}

}  // namespace isostat
