#include "analysis/load_input.hpp"

#include "dem/files/packing_file.hpp"
#include "dem/input_error.hpp"

namespace isostat {

AnalysisInput load_input(const std::string& path, const AnalysisOptions& options) {
  PackingReading reading;
  reading.gap_tolerance = options.gap_tolerance;
  PackingFile file = read_packing(path, reading);
  AnalysisInput input;
  input.path = path;
  input.packing = std::move(file.packing);
  input.packing_3d = std::move(file.packing_3d);
  input.state = std::move(file.state);
  input.links_given = file.links_given;
  const bool has_cell = input.packing_3d ? input.packing_3d->cell.has_value() : input.packing.cell.has_value();
  if (options.cell_free && !has_cell)
    throw InputError(path, 0, "--cell", "free", "needs a periodic cell; this packing is isolated");
  return input;
}

}  // namespace isostat
