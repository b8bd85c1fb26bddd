#include "analysis/load_input.hpp"

#include "dem/files/packing_file.hpp"
#include "dem/input_error.hpp"
#include "dem/state/touching.hpp"

namespace isostat {

AnalysisInput load_input(const std::string& path, const AnalysisOptions& options) {
  PackingReading reading;
  reading.gap_tolerance = options.gap_tolerance;
  reading.box = options.box;
  PackingFile file = read_packing(path, reading);
  AnalysisInput input;
  input.path = path;
  input.state = std::move(file.state);
  input.state.memory = {};  // of the solver; it knows the bodies by their order
  put_free_first(input.state.packing);
  input.packing_3d = std::move(file.packing_3d);
  if (file.spheres && file.spheres->law != SphereLaw{}) {
    input.spheres_state = std::move(file.spheres);
    static_cast<Packing<3>&>(input.spheres_state->packing) = {};  // walls stay
    input.spheres_state->memory = {};
  }
  if (input.packing_3d) put_free_first(*input.packing_3d);
  input.links_given = file.links_given;
  if (!file.links_given && !file.triangles)
    input.touching_tolerance =
        options.gap_tolerance.value_or(input.packing_3d ? default_gap_tolerance(input.packing_3d->bodies)
                                                        : default_gap_tolerance(input.packing().bodies));
  if (file.triangles) input.set_triangles(std::move(*file.triangles), file.corners);
  if (options.cell_free && !input.has_cell())
    throw InputError(path, 0, "--cell", "free", "needs a periodic cell; this packing is isolated");
  return input;
}

}  // namespace isostat
