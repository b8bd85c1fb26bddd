// The arrays of a VTK file with inline base64 data, read back.
#pragma once
#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace isostat::oracle {

inline std::string from_base64(const std::string& text) {
  std::array<int, 256> digit{};
  digit.fill(-1);
  int next = 0;
  for (const char c : std::string("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/"))
    digit[static_cast<unsigned char>(c)] = next++;
  std::string bytes;
  std::uint32_t bits = 0;
  int held = 0;
  for (const char c : text) {
    const int d = digit[static_cast<unsigned char>(c)];
    if (d < 0) break;
    bits = bits << 6 | static_cast<std::uint32_t>(d), held += 6;
    if (held >= 8) held -= 8, bytes += static_cast<char>(bits >> held & 255u);
  }
  return bytes;
}

// Finds a DataArray by name after `from` and returns its values.
template <class Number>
std::vector<Number> vtk_array(const std::string& vtp, const std::string& name, const std::string& from = "<Piece") {
  const std::size_t tag = vtp.find("Name=\"" + name + "\"", vtp.find(from));
  const std::size_t begin = vtp.find(">\n", tag) + 2;
  const std::string data = from_base64(vtp.substr(begin, vtp.find('\n', begin) - begin));
  std::uint64_t bytes = 0;
  std::memcpy(&bytes, data.data(), sizeof bytes);
  std::vector<Number> values(bytes / sizeof(Number));
  std::memcpy(values.data(), data.data() + sizeof bytes, bytes);
  return values;
}

}  // namespace isostat::oracle
