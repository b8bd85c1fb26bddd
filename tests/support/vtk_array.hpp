// The arrays of a VTK file with raw appended data, read back.
#pragma once
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace isostat {

// Finds a DataArray by name after `from` and returns its values from the appended block.
template <class Number>
std::vector<Number> vtk_array(const std::string& vtp, const std::string& name, const std::string& from = "<Piece") {
  const std::size_t tag = vtp.find("Name=\"" + name + "\"", vtp.find(from));
  const std::size_t offset = std::stoul(vtp.substr(vtp.find("offset=\"", tag) + 8));
  const std::size_t block = vtp.find("<AppendedData encoding=\"raw\">\n_") + 31;
  std::uint64_t bytes = 0;
  std::memcpy(&bytes, vtp.data() + block + offset, sizeof bytes);
  std::vector<Number> values(bytes / sizeof(Number));
  std::memcpy(values.data(), vtp.data() + block + offset + sizeof bytes, bytes);
  return values;
}

}  // namespace isostat
