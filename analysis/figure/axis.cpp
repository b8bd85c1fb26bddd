#include "analysis/figure/axis.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "analysis/figure/nice_numbers.hpp"

namespace isostat {
namespace {

constexpr double kMostShown = 1e140;  // beyond it and its inverse, ranges, ratios and their margins overflow
constexpr double kRounding = 1e-9;    // [axis range] a tick this far outside the range is on its end

RichText power_of_ten(int exponent) {
  if (exponent == 0) return plain("1");
  if (exponent == 1) return plain("10");
  return RichText{{"10", false, 0}, {(exponent < 0 ? "\u2212" : "") + std::to_string(std::abs(exponent)), false, 1}};
}

RichText decimal(double x, int decimals) {
  char buffer[400];
  std::snprintf(buffer, sizeof buffer, "%.*f", decimals, std::abs(x));
  const std::string digits = buffer;
  const bool zero = digits.find_first_not_of("0.") == std::string::npos;
  return plain((x < 0 && !zero ? "\u2212" : "") + digits);
}

Ticks linear_ticks(const Axis& axis, double length, double spacing) {
  Ticks result;
  const double range = axis.high - axis.low, wanted = range / std::max(2.0, length / spacing);
  const double step = axis.whole ? std::max(1.0, nice_above(0.5 * wanted)) : nice_above(wanted);
  const double largest = std::max(std::abs(axis.low), std::abs(axis.high));
  int exponent = static_cast<int>(std::floor(std::log10(largest) + kRounding));
  if (exponent >= -3 && exponent < 5) exponent = 0;
  if (exponent != 0) result.factor = plain("\u00d7\u200910") + RichText{power_of_ten(exponent).back()};
  const double unit = std::pow(10, exponent);
  const int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step / unit) + kRounding)));
  const double first_digit = step / std::pow(10, std::floor(std::log10(step) + kRounding));
  const int parts = axis.whole                      ? 1
                    : std::lround(first_digit) == 2 ? 4
                                                    : 5;  // minor steps of 0.5, 1 or 0.2 ... of the decade
  const double minor = step / parts;
  const auto first = static_cast<long>(std::ceil(axis.low / minor - kRounding * range / minor));
  const auto last = static_cast<long>(std::floor(axis.high / minor + kRounding * range / minor));
  for (long k = first; k <= last; ++k) {
    const double value = static_cast<double>(k) * minor;
    result.ticks.push_back({value, k % parts == 0 ? decimal(value / unit, decimals) : RichText{}});
  }
  return result;
}

Ticks log_ticks(const Axis& axis, double length, double spacing) {
  Ticks result;
  const double low = std::log10(axis.low), high = std::log10(axis.high), decades = high - low;
  const double margin = kRounding * decades;
  const int stride = std::max(1, static_cast<int>(std::ceil(spacing * decades / length - kRounding)));
  // With less than three decades on a long axis, 2 and 5 are named too, or every multiple that has a place.
  const double per_decade = length / decades / spacing;
  std::array<bool, 10> named{};
  named[1] = true;
  if (per_decade >= 3) named[2] = named[5] = true;
  if (per_decade >= 8) named[3] = named[4] = true;
  if (per_decade >= 14) named[6] = named[7] = named[8] = true;
  for (int e = static_cast<int>(std::floor(low)); e <= static_cast<int>(std::ceil(high)); ++e) {
    for (int m = 1; m <= 9; ++m) {
      const double value = m * std::pow(10, e), at = std::log10(static_cast<double>(m)) + e;
      if (at < low - margin || at > high + margin) continue;
      const bool decade = m == 1;
      if (decade && e % stride != 0) {
        result.ticks.push_back({value, {}});
      } else if (decade) {
        result.ticks.push_back({value, e >= -2 && e <= 3 && decades < 3 ? number_text(value) : power_of_ten(e)});
      } else if (stride == 1) {
        result.ticks.push_back({value, named[static_cast<std::size_t>(m)] ? number_text(value) : RichText{}});
      }
    }
  }
  return result;
}

}  // namespace

bool Axis::shows(double value) const { return std::abs(value) <= kMostShown && (!log || value >= 1 / kMostShown); }

double Axis::fraction(double value) const {
  return log ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
}

Ticks ticks(const Axis& axis, double length, double spacing) {
  // less than a factor of six: multiples of powers of ten are too few, steps of one size serve a log axis as well
  const bool decades = axis.log && axis.high / axis.low >= 6;
  return decades ? log_ticks(axis, length, spacing) : linear_ticks(axis, length, spacing);
}

}  // namespace isostat
