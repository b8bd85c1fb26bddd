#include "dem/sample/grains_file.hpp"

#include "dem/input_error.hpp"

namespace isostat {
namespace {

template <class System>
bool stands_in_container(const State<System>& state) {
  return !state.packing.part.empty() || state.scene.container.shape != ContainerShape::none;
}

template <int D>
void put_in_cell(Packing<D>& packing, bool contained, const std::string& path, const std::vector<double>& box) {
  const auto refuse = [&](const std::string& rule) { throw InputError(path, 0, "grains.box", "", rule); };
  if (packing.cell) refuse("the file has its own cell; leave grains.box out");
  if (contained) refuse("the file has a container; leave grains.box out");
  if (box.size() != D) refuse("needs " + std::to_string(D) + " edges for this file");
  packing.cell.emplace();
  for (int a = 0; a < D; ++a) packing.cell->length[a] = box[static_cast<std::size_t>(a)];
}

}  // namespace

PackingFile read_grains_file(const std::string& path, const std::vector<double>& box) {
  if (box.empty()) return read_packing(path);
  if (sniff_packing_format(path) != PackingFormat::state) {
    PackingReading reading;
    reading.box = box, reading.box_name = "grains.box";
    return read_packing(path, reading);
  }
  PackingFile file = read_packing(path);
  if (file.packing_3d)
    put_in_cell(*file.packing_3d, file.spheres && stands_in_container(*file.spheres), path, box);
  else if (!file.triangles)
    put_in_cell(file.state.packing, stands_in_container(file.state), path, box);
  return file;
}

}  // namespace isostat
