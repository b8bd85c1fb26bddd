#include "dem/files/atomic_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>
#include <mutex>
#include <regex>
#include <utility>

#include "dem/input_error.hpp"

namespace isostat {
namespace {

[[noreturn]] void refuse(const std::string& path, const std::string& what, int error) {
  throw InputError(path, 0, "", "", what + ": " + std::strerror(error));
}

std::string directory_of(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? "." : slash == 0 ? "/" : path.substr(0, slash);
}

constexpr std::size_t kMostNameBytes = 255;   // NAME_MAX of Linux file systems
constexpr std::size_t kMostSuffixBytes = 40;  // of .tmp.PID.COUNT
constexpr const char* kTemporary = ".tmp.";

std::string name_of(const std::string& path) { return path.substr(path.rfind('/') + 1); }

// A name beside the target that no other thread or process uses; it begins with the target's as far as there is room.
std::string temporary_name(const std::string& path) {
  static std::atomic<unsigned> count{0};
  const std::string name = name_of(path), folder = path.substr(0, path.size() - name.size());
  return folder + name.substr(0, kMostNameBytes - kMostSuffixBytes) + kTemporary + std::to_string(getpid()) + "." +
         std::to_string(count++);
}

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  operator int() const { return number_; }
  bool close() { return ::close(std::exchange(number_, -1)) == 0; }

 private:
  int number_;
};

bool write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

// A file on its way: under a temporary name beside its place, or, where its place is a device or a pipe, which a rename
// would replace, nowhere. Removes what it wrote unless put in place.
class PendingFile {
 public:
  explicit PendingFile(std::string path) : path_(std::move(path)), target_(link_target(path_)) {
    if (name_of(target_).size() > kMostNameBytes) refuse(path_, kRefusal, ENAMETOOLONG);
    struct stat info {};
    if (::stat(path_.c_str(), &info) != 0) return;  // a new file
    if (S_ISDIR(info.st_mode)) refuse(path_, kRefusal, EISDIR);
    special_ = !S_ISREG(info.st_mode);
    std::array<char, PATH_MAX> real{};
    if (::realpath(path_.c_str(), real.data())) target_ = real.data();
  }
  PendingFile(PendingFile&& other) noexcept
      : path_(std::move(other.path_)),
        target_(std::move(other.target_)),
        temporary_(std::exchange(other.temporary_, {})),
        special_(other.special_) {}
  ~PendingFile() {
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
  }

  std::string folder() const { return directory_of(target_); }
  bool is_special() const { return special_; }
  void probe() {
    if (!special_)
      create();
    else if (::access(path_.c_str(), W_OK) != 0)
      refuse(path_, kRefusal, errno);
  }
  void write(std::string_view bytes) {
    Descriptor file = special_ ? Descriptor(::open(path_.c_str(), O_WRONLY | O_CLOEXEC)) : create();
    if (file < 0 || !write_all(file, bytes) || (!special_ && ::fsync(file) != 0) || !file.close())
      refuse(path_, kRefusal, errno);
  }
  void put_in_place() {
    if (special_) return;
    if (std::rename(temporary_.c_str(), target_.c_str()) != 0) refuse(path_, kRefusal, errno);
    temporary_.clear();
    // The new name is safe on disk only when its directory is; a file system that cannot sync directories is no fault.
    const Descriptor directory(::open(directory_of(target_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (directory >= 0) (void)::fsync(directory);
  }

 private:
  static constexpr mode_t kMode = 0666;  // the user's umask takes away from it
  static constexpr const char* kRefusal = "cannot be written";

  Descriptor create() {
    const std::string name = temporary_name(target_);
    const int file = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kMode);
    if (file < 0) refuse(path_, kRefusal, errno);
    temporary_ = name;
    (void)::flock(file, LOCK_SH);  // says that somebody is still at it: remove_abandoned()
    return Descriptor(file);
  }

  std::string path_, target_, temporary_;
  bool special_ = false;
};

}  // namespace

void write_file_atomically(const std::string& path, std::string_view bytes) {
  PendingFile file(path);
  file.write(bytes);
  file.put_in_place();
}

void write_files_atomically(const std::vector<std::pair<std::string, std::string>>& path_and_bytes) {
  std::vector<PendingFile> files;
  for (const auto& [path, bytes] : path_and_bytes) files.emplace_back(path).write(bytes);
  for (PendingFile& file : files) file.put_in_place();
}

void require_writable(const std::string& path) { require_writable(std::vector<std::string>{path}); }

void require_writable(const std::vector<std::string>& paths) {
  std::map<std::string, bool> probed;  // by folder: what one new file may, others may
  for (const std::string& path : paths) {
    if (path.empty()) throw InputError("command line", 0, "", "", "the name of the output file is empty");
    PendingFile file(path);
    if (bool& known = probed[file.folder()]; file.is_special() || !known) file.probe(), known = !file.is_special();
  }
}

void remove_abandoned(const std::vector<std::string>& paths) {
  static const std::regex temporary(R"(([^]*)\.tmp\.(\d{1,9})\.\d+)");
  std::map<std::string, std::vector<std::string>> names;  // sorted, by folder
  for (const std::string& path : paths)
    names[directory_of(path)].push_back(name_of(path).substr(0, kMostNameBytes - kMostSuffixBytes));
  for (auto& [folder, list] : names) {
    std::sort(list.begin(), list.end());
    std::error_code error;
    std::vector<std::filesystem::path> found;
    for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
      const std::string name = entry->path().filename().native();
      std::smatch match;
      if (std::regex_match(name, match, temporary) && std::binary_search(list.begin(), list.end(), match[1].str()) &&
          ::kill(std::stoi(match[2].str()), 0) != 0 && errno == ESRCH)  // not here; elsewhere it would hold the lock
        found.push_back(entry->path());
    }
    for (const std::filesystem::path& path : found) {
      const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW));
      if (file >= 0 && ::flock(file, LOCK_EX | LOCK_NB) == 0) ::unlink(path.c_str());
    }
  }
}

namespace {

std::string read_all(const Descriptor& file, const std::string& path, std::size_t expected, std::size_t most) {
  std::string bytes;
  bytes.reserve(expected + 1);
  constexpr std::size_t kBlock = std::size_t{1} << 20;
  for (;;) {
    if (bytes.size() > most)
      throw InputError(path, 0, "", "", "is endless, or longer than 4 GiB and no regular file: write it to a file");
    const std::size_t before = bytes.size();
    bytes.resize(before + kBlock);
    const ssize_t got = ::read(file, bytes.data() + before, kBlock);
    bytes.resize(before + static_cast<std::size_t>(got > 0 ? got : 0));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) refuse(path, "cannot be read", errno);
    if (got == 0) return bytes;
  }
}

}  // namespace

std::string link_target(std::string path) {
  constexpr int kMostLinks = 40;  // as the kernel
  for (int k = 0; k <= kMostLinks; ++k) {
    std::array<char, PATH_MAX> text{};
    const ssize_t length = ::readlink(path.c_str(), text.data(), text.size() - 1);
    if (length < 0) return path;
    const std::string next(text.data(), static_cast<std::size_t>(length));
    path = next.starts_with('/') ? next : directory_of(path) + "/" + next;
  }
  refuse(path, "cannot be written", ELOOP);
}

std::string read_whole_file(const std::string& path) {
  static std::map<std::string, std::string> pipes;  // what came out of one comes only once
  static std::mutex lock;
  struct stat info {};
  if (::stat(path.c_str(), &info) != 0) refuse(path, "cannot be read", errno);
  if (S_ISDIR(info.st_mode)) refuse(path, "cannot be read", EISDIR);
  const bool regular = S_ISREG(info.st_mode);
  std::unique_lock hold(lock, std::defer_lock);
  if (!regular) {
    hold.lock();
    if (const auto known = pipes.find(path); known != pipes.end()) return known->second;
  }
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file < 0) refuse(path, "cannot be read", errno);
  constexpr std::size_t kMostOfAPipe = std::size_t{1} << 32;
  if (regular) return read_all(file, path, static_cast<std::size_t>(info.st_size), SIZE_MAX);
  return pipes[path] = read_all(file, path, 0, kMostOfAPipe);
}

std::string first_bytes(const std::string& path, std::size_t most) {
  struct stat info {};
  if (::stat(path.c_str(), &info) == 0 && !S_ISREG(info.st_mode)) return read_whole_file(path).substr(0, most);
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file < 0) refuse(path, "cannot be read", errno);
  std::string bytes(most, '\0');
  std::size_t size = 0;
  while (size < most) {
    const ssize_t got = ::read(file, bytes.data() + size, most - size);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) refuse(path, "cannot be read", errno);
    if (got == 0) break;
    size += static_cast<std::size_t>(got);
  }
  bytes.resize(size);
  return bytes;
}

}  // namespace isostat
