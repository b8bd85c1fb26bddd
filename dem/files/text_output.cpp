#include "dem/files/text_output.hpp"

#include <cstdio>

#include "dem/files/atomic_file.hpp"

namespace isostat {

void write_text_files(const std::vector<std::pair<std::string, std::string>>& path_and_content) {
  write_files_atomically(path_and_content);
}

void append_real(std::string& text, double value) {
  char buffer[40];
  text.append(buffer, static_cast<std::size_t>(std::snprintf(buffer, sizeof buffer, "%.17g", value)));
}

}  // namespace isostat
