// Where a command's JSON or text result goes: `-` (default) is stdout, anything else a file written atomically.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "apps/arguments.hpp"

namespace isostat {

void write_json(const Arguments& args, const nlohmann::ordered_json& json);  // to the value of --json
// As a file holds it; names of files are bytes, and what is no UTF-8 in them becomes U+FFFD.
std::string json_text(const nlohmann::ordered_json& json, int indent);
void write_text(const std::string& path, std::string_view text);

}  // namespace isostat
