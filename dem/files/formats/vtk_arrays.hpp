// The arrays of a VTK file in XML, inline: in base64, each a 64-bit count of bytes and the values, little endian. Raw
// appended data would be shorter, but is no well-formed XML: Debian's ParaView 5.11 does not open it.
#pragma once
#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "dem/files/formats/base64.hpp"

namespace isostat {

static_assert(std::endian::native == std::endian::little, "the files are written as little endian");

template <class Number>
constexpr std::string_view vtk_type() {
  if constexpr (std::is_same_v<Number, double>) return "Float64";
  if constexpr (std::is_same_v<Number, std::int64_t>) return "Int64";
  if constexpr (std::is_same_v<Number, std::int32_t>) return "Int32";
  if constexpr (std::is_same_v<Number, std::int8_t>) return "Int8";
}

// attributes: what the tag has beside type, name, components and format, with a space before it.
template <class Number>
std::string vtk_array(const std::string& name, const std::vector<Number>& values, int components = 1,
                      const std::string& attributes = {}) {
  const std::uint64_t bytes = values.size() * sizeof(Number);
  std::string data(sizeof bytes + bytes, '\0');
  std::memcpy(data.data(), &bytes, sizeof bytes);
  if (bytes > 0) std::memcpy(data.data() + sizeof bytes, values.data(), bytes);
  return "<DataArray type=\"" + std::string(vtk_type<Number>()) + "\" Name=\"" + name + "\" NumberOfComponents=\"" +
         std::to_string(components) + "\"" + attributes + " format=\"binary\">\n" + base64(data) + "\n</DataArray>\n";
}

// The head of a file of polygonal data, with the time as field data, and what closes its piece and the file.
inline std::string vtk_polydata_head(double time) {
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
         "header_type=\"UInt64\">\n<PolyData>\n<FieldData>\n" +
         vtk_array("TimeValue", std::vector<double>{time}, 1, " NumberOfTuples=\"1\"") + "</FieldData>\n";
}
inline constexpr std::string_view kVtkPolydataTail = "</Piece>\n</PolyData>\n</VTKFile>\n";

}  // namespace isostat
