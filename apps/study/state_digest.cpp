#include "apps/study/state_digest.hpp"

#include <filesystem>
#include <map>
#include <tuple>

#include "dem/files/state_file.hpp"

namespace isostat {

const StateDigest& state_digest(const std::string& path) {
  using Version = std::tuple<std::string, std::uintmax_t, std::filesystem::file_time_type>;
  static std::map<Version, StateDigest> known;
  std::error_code missing;  // read_state_file says it better
  const Version version{path, std::filesystem::file_size(path, missing),
                        std::filesystem::last_write_time(path, missing)};
  const auto found = known.find(version);
  if (found != known.end()) return found->second;
  StateFile file = read_state_file(path);
  return std::visit(
      [&](auto& state) -> const StateDigest& {
        return known[version] = {std::move(file.hash), state.seed, std::move(state.scene)};
      },
      file.state);
}

}  // namespace isostat
