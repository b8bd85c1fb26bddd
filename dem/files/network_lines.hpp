// Lines of `.net` files: fields and numbers. For the readers of both kinds of network.
#pragma once
#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <type_traits>
#include <vector>

namespace isostat::network_lines {

using Fields = std::vector<std::string_view>;

// Fields of a line, comment removed.
inline void split(std::string_view line, Fields& fields) {
  fields.clear();
  line = line.substr(0, line.find('#'));
  constexpr std::string_view space = " \t\r\v\f";
  for (std::size_t at = line.find_first_not_of(space); at != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(space, at), line.size());
    fields.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(space, end);
  }
}

// Calls f(line number, fields) for every line that has a field.
template <class F>
void each_line(std::string_view text, F&& f) {
  Fields fields;
  int line = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    split(text.substr(at, end - at), fields);
    ++line;
    at = end + 1;
    if (!fields.empty()) f(line, fields);
  }
}

// The whole text as a number; reals must be finite.
template <class Number>
std::optional<Number> number(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  if constexpr (std::is_floating_point_v<Number>) {
    if (!std::isfinite(value)) return std::nullopt;
  }
  return value;
}

}  // namespace isostat::network_lines
