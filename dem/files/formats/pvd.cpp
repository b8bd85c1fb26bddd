#include "dem/files/formats/pvd.hpp"

#include <cstdio>

#include "dem/files/formats/real_text.hpp"

namespace isostat {
namespace {

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  return out;
}

}  // namespace

std::string pvd_collection(const std::vector<PvdFrame>& frames) {
  std::string xml =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
      "<Collection>\n";
  for (const PvdFrame& frame : frames) {
    xml += "<DataSet timestep=\"";
    append_real(xml, frame.time);
    xml += "\" group=\"\" part=\"0\" file=\"" + escaped(frame.file) + "\"/>\n";
  }
  return xml + "</Collection>\n</VTKFile>\n";
}

std::string pvd_frame_path(const std::string& path, std::size_t number) {
  char label[32];
  std::snprintf(label, sizeof label, ".%04zu.vtp", number);
  return path.substr(0, path.size() - 4) + label;
}

}  // namespace isostat
