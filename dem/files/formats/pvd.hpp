// A collection of VTK files in time for ParaView (docs/formats.md).
#pragma once
#include <string>
#include <vector>

namespace isostat {

struct PvdFrame {
  double time = 0;
  std::string file;  // beside the collection
};

std::string pvd_collection(const std::vector<PvdFrame>& frames);

// "film.pvd", 3 -> "film.0003.vtp".
std::string pvd_frame_path(const std::string& path, std::size_t number);

}  // namespace isostat
