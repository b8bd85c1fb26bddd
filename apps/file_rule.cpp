#include "apps/file_rule.hpp"

#include <filesystem>

#include "dem/files/atomic_file.hpp"

namespace isostat {
namespace fs = std::filesystem;

std::string FileRule::place(const std::string& path) {
  const fs::path target = link_target(path);
  const std::string folder = target.has_parent_path() ? target.parent_path().string() : ".";
  const auto [known, is_new] = folders_.try_emplace(folder);
  if (is_new) {
    std::error_code error;
    const fs::path real = fs::canonical(folder, error);
    known->second = error ? folder : real.string();
  }
  return (fs::path(known->second) / target.filename()).string();
}

void FileRule::add(const std::string& role, const std::string& path, bool written) {
  std::error_code error;
  if (path.empty() || path == "-") return;
  if (const fs::file_status status = fs::status(path, error); fs::exists(status) && !fs::is_regular_file(status))
    return;
  const std::string at = place(path);
  const auto [other, is_new] = uses_.try_emplace(at, Use{role, written});
  if (!is_new && (written || other->second.written)) {
    const std::string& earlier = other->second.role;
    faults_.push_back(
        {"command line", 0, written ? role : earlier, path,
         "the file is also " + (written ? earlier : role) + ": an output is no input and no other output"});
  }
  const std::string folder = fs::path(at).parent_path().string(), name = fs::path(at).filename().string();
  for (const Numbered& n : numbered_)
    if (folder == n.folder && name.starts_with(n.start) && name.ends_with(".h5") &&
        name.find_first_not_of("0123456789", n.start.size()) == name.size() - 3)
      faults_.push_back({"command line", 0, role, path, "the file may also be one of " + n.role});
}

void FileRule::reads(const std::string& role, const std::string& path) { add(role, path, false); }
void FileRule::writes(const std::string& role, const std::string& path) { add(role, path, true); }

void FileRule::writes_numbered(const std::string& role, const std::string& state, const std::string& label) {
  const fs::path at = place(state);
  numbered_.push_back({role, at.parent_path().string(), at.stem().string() + "." + label});
}

void FileRule::require() const {
  if (!faults_.empty()) throw InputError(faults_);
}

}  // namespace isostat
