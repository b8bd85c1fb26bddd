#include "analysis/figure/nice_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace isostat {
namespace {

std::string fixed(double x, int decimals) {
  char buffer[400];
  std::snprintf(buffer, sizeof buffer, "%.*f", decimals, x);
  return buffer;
}

// The typographic minus.
RichText with_minus(std::string s) {
  if (!s.empty() && s[0] == '-') s.replace(0, 1, "\u2212");
  return plain(s);
}

}  // namespace

double nice_below(double x) {
  const double decade = std::pow(10, std::floor(std::log10(x)));
  // the margin keeps 5 x 10^n itself, which log10 and pow reach only to rounding
  for (const double m : {10.0, 5.0, 2.0})
    if (x >= m * decade * (1 - 1e-12)) return m * decade;
  return decade;
}

double nice_above(double x) {
  const double below = nice_below(x);
  if (x <= below * (1 + 1e-12)) return below;
  for (const double step : {2.0, 2.5})  // 1 -> 2 -> 5 -> 10
    if (nice_below(step * below * (1 + 1e-9)) > below) return nice_below(step * below * (1 + 1e-9));
  return 10 * below;
}

RichText number_text(double x, int digits) {
  if (!std::isfinite(x)) return plain("?");
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "%.*e", digits - 1, x);
  const std::string scientific = buffer;
  const std::size_t e = scientific.find('e');
  const int exponent = std::stoi(scientific.substr(e + 1));
  if (x == 0) return plain("0");
  if (exponent >= -3 && exponent < 5) {
    std::string s = fixed(x, std::max(0, digits - 1 - exponent));
    if (s.find('.') != std::string::npos) {
      s.erase(s.find_last_not_of('0') + 1);
      if (s.back() == '.') s.pop_back();
    }
    return with_minus(s);
  }
  std::string mantissa = scientific.substr(0, e);
  if (mantissa.find('.') != std::string::npos) {
    mantissa.erase(mantissa.find_last_not_of('0') + 1);
    if (mantissa.back() == '.') mantissa.pop_back();
  }
  const std::string power = (exponent < 0 ? "\u2212" : "") + std::to_string(std::abs(exponent));
  RichText ten = RichText{{"10", false, 0}, {power, false, 1}};
  if (mantissa == "1") return ten;
  if (mantissa == "-1") return plain("\u2212") + ten;
  return with_minus(mantissa + "\u2009\u00d7\u2009") + ten;
}

RichText number_text_with_error(double x, double error) {
  if (!(error > 0) || !std::isfinite(error)) return number_text(x);
  const int decade = static_cast<int>(std::floor(std::log10(error)));
  const int decimals = (error / std::pow(10, decade) < 3 ? 1 : 0) - decade;
  const double size = std::max(std::abs(x), error);
  if (size >= 1e5 || size < 1e-3) {
    const int exponent = static_cast<int>(std::floor(std::log10(size)));
    const double unit = std::pow(10, exponent);
    const int d = std::max(0, decimals + exponent);
    RichText text =
        with_minus("(" + fixed(x / unit, d) + " \u00b1 " + fixed(error / unit, d) + ")\u2009\u00d7\u200910");
    text.push_back({(exponent < 0 ? "\u2212" : "") + std::to_string(std::abs(exponent)), false, 1});
    return text;
  }
  const int d = std::max(0, decimals);
  return with_minus(fixed(x, d)) + plain(" \u00b1 " + fixed(error, d));
}

}  // namespace isostat
