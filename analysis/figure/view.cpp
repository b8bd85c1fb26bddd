#include "analysis/figure/view.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace isostat {

View view_from(double azimuth, double elevation) {
  const double a = azimuth * std::numbers::pi / 180, e = elevation * std::numbers::pi / 180;
  const double ca = std::cos(a), sa = std::sin(a), ce = std::cos(e), se = std::sin(e);
  return {{{-sa, ca, 0}}, {{-se * ca, -se * sa, ce}}, {{ce * ca, ce * sa, se}}};
}

View view_along(int axis) {
  static constexpr std::array<View, 3> kViews{{{{{0, 1, 0}}, {{0, 0, 1}}, {{1, 0, 0}}},
                                               {{{1, 0, 0}}, {{0, 0, 1}}, {{0, -1, 0}}},
                                               {{{1, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}}}}};
  return kViews[static_cast<std::size_t>(axis)];
}

}  // namespace isostat
