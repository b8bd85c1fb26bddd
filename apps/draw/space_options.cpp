#include "apps/draw/space_options.hpp"

#include <charconv>
#include <cmath>
#include <string>

#include "dem/input_error.hpp"

namespace isostat {
namespace {

constexpr double kAzimuth = -60, kElevation = 20;  // [degrees]

std::optional<double> number_in(std::string_view text) {
  double value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || stop != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<int> axis_in(std::string_view text) {
  if (text.size() != 1 || text[0] < 'x' || text[0] > 'z') return std::nullopt;
  return text[0] - 'x';
}

}  // namespace

View view_of(const Arguments& arguments) {
  const auto text = arguments.value("--view");
  if (!text) return view_from(kAzimuth, kElevation);
  if (const auto axis = axis_in(*text)) return view_along(*axis);
  if (const std::size_t comma = text->find(','); comma != std::string::npos) {
    const auto azimuth = number_in(std::string_view(*text).substr(0, comma)),
               elevation = number_in(std::string_view(*text).substr(comma + 1));
    if (azimuth && elevation && std::abs(*azimuth) <= 360 && std::abs(*elevation) <= 90)
      return view_from(*azimuth, *elevation);
  }
  throw InputError("command line", 0, "--view", *text,
                   "must be x, y, z or AZIMUTH,ELEVATION in degrees, at most 360 and 90, as in -60,20");
}

std::optional<Slice> slice_of(const Arguments& arguments) {
  const auto text = arguments.value("--slice");
  if (!text) return std::nullopt;
  if (arguments.has("--view"))
    throw InputError("command line", 0, "--slice", *text, "is seen along its own axis: leave --view out");
  if (text->size() > 2 && (*text)[1] == '=') {
    const auto axis = axis_in(std::string_view(*text).substr(0, 1));
    const auto at = number_in(std::string_view(*text).substr(2));
    if (axis && at) return Slice{*axis, *at};
  }
  throw InputError("command line", 0, "--slice", *text, "must be x=, y= or z= and a position, as in z=0.5");
}

}  // namespace isostat
