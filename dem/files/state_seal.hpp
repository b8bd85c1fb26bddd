// The first 512 bytes of a state file: a few readable words with the length and the digest of the HDF5 data that
// follow, so that any damage is found before the HDF5 library, which does not survive every damaged file, sees a byte.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>

namespace isostat {

inline constexpr std::size_t kSealBytes = 512;  // a user block in the sense of HDF5
inline constexpr int kStateFormatVersion = 3;   // docs/formats.md

// Fills the first kSealBytes of an HDF5 image that has a user block of that size.
void seal_state(std::string& image);

// Throws InputError unless the bytes carry a seal of this format version that fits them.
void check_seal(std::string_view image, const std::string& path);

// Whether the bytes begin like a state file of any version.
bool begins_like_state(std::string_view bytes);

}  // namespace isostat
