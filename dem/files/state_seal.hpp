// The first 512 bytes of a state file: a few readable words with the length and the digest of the HDF5 data that
// follow, so that any damage is found before the HDF5 library, which does not survive every damaged file, sees a byte.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>

namespace isostat {

inline constexpr std::size_t kSealBytes = 512;  // a user block in the sense of HDF5
inline constexpr int kStateFormatVersion = 7;   // that is written; docs/formats.md
inline constexpr int kOldestStateFormat = 3;    // that is read

// Fills the first kSealBytes of an HDF5 image that has a user block of that size.
void seal_state(std::string& image);

// Throws InputError unless the bytes carry a seal of a format version from the oldest that is read to the present one,
// and one that fits them; gives that version.
int check_seal(std::string_view image, const std::string& path);

// Whether the bytes begin like a state file of any version.
bool begins_like_state(std::string_view bytes);

}  // namespace isostat
