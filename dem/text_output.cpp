#include "dem/text_output.hpp"

#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "dem/input_error.hpp"

namespace isostat {
namespace {

void remove_all(const std::vector<std::string>& paths) {
  std::error_code ignored;
  for (const std::string& p : paths) std::filesystem::remove(p, ignored);
}

}  // namespace

void write_text_files(const std::vector<std::pair<std::string, std::string>>& path_and_content) {
  std::vector<std::string> temporaries;
  for (const auto& [path, content] : path_and_content) {
    temporaries.push_back(path + ".part" + std::to_string(::getpid()));
    std::ofstream file(temporaries.back(), std::ios::binary | std::ios::trunc);
    file << content;
    file.close();
    std::error_code ignored;
    if (file && !std::filesystem::is_directory(path, ignored)) continue;
    remove_all(temporaries);
    throw InputError(path, 0, "", "", "cannot be written (directory, permission or disk space)");
  }
  for (std::size_t k = 0; k < temporaries.size(); ++k) {
    std::error_code error;
    std::filesystem::rename(temporaries[k], path_and_content[k].first, error);
    if (!error) continue;
    remove_all(temporaries);
    throw InputError(path_and_content[k].first, 0, "", "", "cannot be written: " + error.message());
  }
}

void append_real(std::string& text, double value) {
  char buffer[40];
  text.append(buffer, static_cast<std::size_t>(std::snprintf(buffer, sizeof buffer, "%.17g", value)));
}

}  // namespace isostat
