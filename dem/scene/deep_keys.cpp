#include "dem/scene/deep_keys.hpp"

#include "dem/input_error.hpp"

namespace isostat {

void refuse_deep_keys(std::string_view text, const std::string& file) {
  constexpr int kMostDots = 2000;
  int line = 1, dots = 0;
  for (const char c : text) {
    if (c == '\n') ++line, dots = 0;
    if (c == '.' && ++dots > kMostDots)
      throw InputError(file, line, "", "", "at most " + std::to_string(kMostDots) + " points in a line; break it");
  }
}

}  // namespace isostat
