// Digests of 128 bits as text.
#pragma once
#include <cstdint>
#include <string>

namespace isostat {

// 32 digits, the high word first.
inline std::string hex_digest(std::uint64_t high, std::uint64_t low) {
  constexpr char digits[] = "0123456789abcdef";
  std::string text;
  for (const std::uint64_t word : {high, low})
    for (int shift = 60; shift >= 0; shift -= 4) text += digits[(word >> shift) & 15];
  return text;
}

}  // namespace isostat
