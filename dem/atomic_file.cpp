#include "dem/atomic_file.hpp"

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
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  operator int() const { return number_; }
  bool close() {
    const int number = number_;
    number_ = -1;
    return ::close(number) == 0;
  }

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

// Where the bytes are to go: the target of a symbolic link, and never a directory or a device, which a rename would
// replace.
std::string destination(const std::string& path) {
  struct stat info {};
  if (::stat(path.c_str(), &info) != 0) return path;  // a new file
  if (S_ISDIR(info.st_mode)) refuse(path, "cannot be written", EISDIR);
  if (!S_ISREG(info.st_mode)) throw InputError(path, 0, "", "", "cannot be written: not a regular file");
  std::array<char, PATH_MAX> real{};
  return ::realpath(path.c_str(), real.data()) ? std::string(real.data()) : path;
}

constexpr mode_t kMode = 0666;  // the user's umask takes away from it

}  // namespace

void write_file_atomically(const std::string& path, std::string_view bytes) {
  const std::string target = destination(path), temporary = temporary_name(target);
  Descriptor file(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kMode));
  if (file < 0) refuse(path, "cannot be written", errno);
  const bool written = write_all(file, bytes) && ::fsync(file) == 0;
  int error = errno;
  const bool closed = file.close();
  if (written && !closed) error = errno;
  if (!written || !closed || std::rename(temporary.c_str(), target.c_str()) != 0) {
    if (written && closed) error = errno;
    ::unlink(temporary.c_str());
    refuse(path, "cannot be written", error);
  }
  // The new name is safe on disk only when its directory is; a file system that cannot sync directories is no fault.
  const Descriptor directory(::open(directory_of(target).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (directory >= 0) (void)::fsync(directory);
}

void require_writable(const std::string& path) {
  if (path.empty()) throw InputError("command line", 0, "", "", "the name of the output file is empty");
  const std::string temporary = temporary_name(destination(path));
  const Descriptor file(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kMode));
  if (file < 0) refuse(path, "cannot be written", errno);
  ::unlink(temporary.c_str());
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
