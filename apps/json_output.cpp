#include "apps/json_output.hpp"

#include <iostream>
#include <nlohmann/json.hpp>

#include "dem/files/atomic_file.hpp"

namespace isostat {

void write_text(const std::string& path, std::string_view text) {
  if (path == "-")
    std::cout << text << std::flush;
  else
    write_file_atomically(path, text);
}

void write_json(const Arguments& args, const nlohmann::ordered_json& json) {
  write_text(args.value("--json").value_or("-"), json.dump(2) + "\n");
}

}  // namespace isostat
