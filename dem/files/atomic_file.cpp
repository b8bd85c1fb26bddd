#include "dem/files/atomic_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstdlib>
#include <cstring>
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

// A name beside the target that no other thread or process uses.
std::string temporary_name(const std::string& path) {
  static std::atomic<unsigned> count{0};
  return path + ".tmp." + std::to_string(getpid()) + "." + std::to_string(count++);
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
  explicit PendingFile(std::string path) : path_(std::move(path)), target_(path_) {
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

void require_writable(const std::string& path) {
  if (path.empty()) throw InputError("command line", 0, "", "", "the name of the output file is empty");
  PendingFile(path).probe();
}

std::string read_whole_file(const std::string& path) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file < 0) refuse(path, "cannot be read", errno);
  struct stat info {};
  if (::fstat(file, &info) != 0) refuse(path, "cannot be read", errno);
  if (S_ISDIR(info.st_mode)) refuse(path, "cannot be read", EISDIR);
  std::string bytes;
  bytes.reserve(static_cast<std::size_t>(info.st_size) + 1);
  constexpr std::size_t kBlock = std::size_t{1} << 20;
  for (;;) {
    const std::size_t before = bytes.size();
    bytes.resize(before + kBlock);
    const ssize_t got = ::read(file, bytes.data() + before, kBlock);
    bytes.resize(before + static_cast<std::size_t>(got > 0 ? got : 0));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) refuse(path, "cannot be read", errno);
    if (got == 0) return bytes;
  }
}

}  // namespace isostat
