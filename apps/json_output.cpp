#include "apps/json_output.hpp"

#include <iostream>
#include <nlohmann/json.hpp>

#include "apps/file_rule.hpp"
#include "dem/files/atomic_file.hpp"

namespace isostat {

void write_text(const std::string& path, std::string_view text) {
  if (path == "-")
    std::cout << text << std::flush;
  else
    write_file_atomically(path, text);
}

std::string json_text(const nlohmann::ordered_json& json, int indent) {
  return json.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

void write_json(const Arguments& args, const nlohmann::ordered_json& json) {
  const std::string path = args.value("--json").value_or("-");
  FileRule rule;
  for (const std::string& input : args.inputs()) rule.reads("INPUT", input);
  for (const char* option : {"--json", "--raw", "--scan"}) rule.writes(option, args.value(option).value_or(""));
  rule.require();
  write_text(path, json_text(json, 2));
}

}  // namespace isostat
