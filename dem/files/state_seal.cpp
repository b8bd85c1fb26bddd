#include "dem/files/state_seal.hpp"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <charconv>
#include <optional>

#include "dem/input_error.hpp"
#include "dem/state/hex_digest.hpp"

namespace isostat {
namespace {

constexpr std::string_view kMagic = "isostat state, format version ";
constexpr std::string_view kLength = "\nbytes ";
constexpr std::string_view kDigest = "\nxxh3-128 ";

std::string digest(std::string_view data) {
  const XXH128_hash_t h = XXH3_128bits(data.data(), data.size());
  return hex_digest(h.high64, h.low64);
}

// The words of a seal; they are a function of the data alone.
std::string words(std::string_view data, unsigned long long version) {
  return std::string(kMagic) + std::to_string(version) + std::string(kLength) + std::to_string(data.size()) +
         std::string(kDigest) + digest(data) + "\nHDF5 data begin at byte 512; read them with any HDF5 tool.\n";
}

// The number that follows a label somewhere in the seal.
std::optional<unsigned long long> number_after(std::string_view seal, std::string_view label) {
  const std::size_t at = seal.find(label);
  if (at == std::string_view::npos) return std::nullopt;
  unsigned long long value = 0;
  const char* first = seal.data() + at + label.size();
  const auto [end, error] = std::from_chars(first, seal.data() + seal.size(), value);
  return error == std::errc() && end != first ? std::optional(value) : std::nullopt;
}

}  // namespace

void seal_state(std::string& image) {
  const std::string text = words(std::string_view(image).substr(kSealBytes), kStateFormatVersion);
  image.replace(0, kSealBytes, kSealBytes, '\0');
  image.replace(0, text.size(), text);
}

bool begins_like_state(std::string_view bytes) { return bytes.starts_with(kMagic); }

int check_seal(std::string_view image, const std::string& path) {
  if (!begins_like_state(image)) throw InputError(path, 0, "", "", "not a state file of isostat");
  const std::string_view seal = image.substr(0, kSealBytes);
  const auto version = number_after(seal, kMagic);
  if (!version || *version < kOldestStateFormat || *version > kStateFormatVersion) {
    std::string read = std::to_string(kOldestStateFormat);
    if (kOldestStateFormat < kStateFormatVersion) read += " to " + std::to_string(kStateFormatVersion);
    throw InputError(path, 0, "format_version", version ? std::to_string(*version) : "",
                     "this isostat reads format version " + read + "; use the isostat that wrote the file");
  }
  const auto length = number_after(seal, kLength);
  const std::size_t bytes = image.size() > kSealBytes ? image.size() - kSealBytes : 0;
  if (!length || image.size() < kSealBytes || bytes < *length)
    throw InputError(path, 0, "", "",
                     "truncated: " + std::to_string(bytes) + " bytes of data, " +
                         (length ? std::to_string(*length) : std::string("an unknown number")) + " were written");
  const std::string_view data = image.substr(kSealBytes);
  std::string expected = words(data, *version);
  expected.resize(kSealBytes, '\0');
  if (seal != expected)
    throw InputError(path, 0, "", "",
                     "damaged, or edited by another program: the checksum of state format version " +
                         std::to_string(*version) + " does not fit the data");
  return static_cast<int>(*version);
}

}  // namespace isostat
