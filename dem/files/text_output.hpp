// Text files that appear complete or not at all: written to temporary names in the same directory, then renamed.
#pragma once
#include <string>
#include <utility>
#include <vector>

namespace isostat {

// All files are written in full before the first is renamed. Throws InputError if one cannot be written; no temporary
// is left.
void write_text_files(const std::vector<std::pair<std::string, std::string>>& path_and_content);

// Appends a real with 17 significant digits (enough to read the same bits back); NaN as "nan".
void append_real(std::string& text, double value);

}  // namespace isostat
