// Where a scene of triangles begins: its file, or a placement.
#include "dem/files/state_file.hpp"
#include "dem/triangles/sample.hpp"

namespace isostat {

State<TriangleGrains> initial_triangles(const Scene& scene, std::uint64_t seed) {
  const std::string& path = scene.triangle_grains.file;
  if (path.empty()) return place_triangles(scene, seed);
  return start_from(read_state<TriangleGrains>(path), path, scene, seed);
}

}  // namespace isostat
