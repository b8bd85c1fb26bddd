// Reals in the text formats.
#pragma once
#include <cstddef>
#include <cstdio>
#include <string>

namespace isostat {

// Appends a real with 17 significant digits (enough to read the same bits back); NaN as "nan".
inline void append_real(std::string& text, double value) {
  char buffer[40];
  text.append(buffer, static_cast<std::size_t>(std::snprintf(buffer, sizeof buffer, "%.17g", value)));
}

}  // namespace isostat
