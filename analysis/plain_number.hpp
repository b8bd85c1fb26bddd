// Numbers in sentences.
#pragma once
#include <cstdio>
#include <string>

namespace isostat {

inline std::string plain_number(double x) {  // four significant digits
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.4g", x);
  return buffer;
}

}  // namespace isostat
