// toml++ nests one table for each component of a dotted key and unwinds them by recursion: a key of a hundred thousand
// components would exhaust the stack. Asked before every file is parsed.
#pragma once
#include <string>
#include <string_view>

namespace isostat {

// Throws InputError naming the file and the line. A line with few dots has no such key.
void refuse_deep_keys(std::string_view text, const std::string& file);

}  // namespace isostat
