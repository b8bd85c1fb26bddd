// Two SVG pictures are the same: the same marks in the same order, coordinates to a fiftieth of a point.
#pragma once
#include <cmath>
#include <regex>
#include <string>

namespace isostat {

inline constexpr double kSamePlace = 0.02;  // [pt]; the last digit written is 0.01

// Where two pictures differ first; empty if they do not.
inline std::string picture_difference(const std::string& a, const std::string& b) {
  static const std::regex number("-?[0-9]*\\.?[0-9]+");
  std::sregex_iterator x(a.begin(), a.end(), number), y(b.begin(), b.end(), number);
  const std::sregex_iterator end;
  for (; x != end && y != end; ++x, ++y) {
    if (x->prefix() != y->prefix()) return "'" + x->prefix().str() + "' is '" + y->prefix().str() + "'";
    const std::string at = " after '" + x->prefix().str() + "'";
    if (std::abs(std::stod(x->str()) - std::stod(y->str())) > kSamePlace) return x->str() + " is " + y->str() + at;
  }
  return x == end && y == end ? "" : "one has more marks than the other";
}

}  // namespace isostat
