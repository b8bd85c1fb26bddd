// Where a command's JSON or text result goes: `-` (default) is stdout, anything else a file written atomically.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "apps/arguments.hpp"

namespace isostat {

void write_json(const Arguments& args, const nlohmann::ordered_json& json);  // to the value of --json
void write_text(const std::string& path, std::string_view text);

}  // namespace isostat
