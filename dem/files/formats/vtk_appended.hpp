// The arrays of a VTK file in XML with raw appended data: little endian, 64-bit headers.
#pragma once
#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

namespace isostat {

static_assert(std::endian::native == std::endian::little, "raw appended data is written as little endian");

// Header lines in the order of the arrays, and the appended block they point into.
class VtkAppended {
 public:
  template <class Number>
  std::string array(const std::string& name, const std::vector<Number>& values, int components = 1) {
    const char* type = std::is_same_v<Number, double>         ? "Float64"
                       : std::is_same_v<Number, std::int64_t> ? "Int64"
                                                              : "Int8";
    std::string header = "<DataArray type=\"" + std::string(type) + "\" Name=\"" + name + "\" NumberOfComponents=\"" +
                         std::to_string(components) + "\" format=\"appended\" offset=\"" +
                         std::to_string(block_.size()) + "\"/>\n";
    const std::uint64_t bytes = values.size() * sizeof(Number);
    const std::size_t at = block_.size();
    block_.resize(at + sizeof bytes + bytes);
    std::memcpy(block_.data() + at, &bytes, sizeof bytes);
    if (bytes > 0) std::memcpy(block_.data() + at + sizeof bytes, values.data(), bytes);
    return header;
  }

  // The head of a file of polygonal data, with the time as field data.
  std::string polydata_head(double time) {
    std::string field = array("TimeValue", std::vector<double>{time});
    field.insert(field.find(" format="), " NumberOfTuples=\"1\"");
    return "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
           "header_type=\"UInt64\">\n<PolyData>\n<FieldData>\n" +
           field + "</FieldData>\n";
  }
  // What closes its piece and the file.
  std::string polydata_tail() const {
    return "</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_" + block_ + "\n</AppendedData>\n</VTKFile>\n";
  }

 private:
  std::string block_;
};

}  // namespace isostat
