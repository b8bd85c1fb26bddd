// isostat convert INPUT -o OUTPUT [--box L1,L2[,L3]]: the output's extension names its format.
#include <charconv>
#include <cmath>
#include <functional>

#include "apps/arguments.hpp"
#include "apps/commands.hpp"
#include "apps/file_rule.hpp"
#include "dem/files/atomic_file.hpp"
#include "dem/files/formats/csv.hpp"
#include "dem/files/formats/dump.hpp"
#include "dem/files/formats/vtp.hpp"
#include "dem/files/formats/xyz.hpp"
#include "dem/files/network_file.hpp"
#include "dem/files/packing_file.hpp"
#include "dem/files/state_file.hpp"
#include "dem/input_error.hpp"
#include "dem/spheres/vtp.hpp"
#include "dem/triangles/network_file.hpp"
#include "dem/triangles/state_check.hpp"
#include "dem/triangles/vtp.hpp"

namespace isostat {
namespace {

std::vector<double> parse_box(const std::string& text) {
  std::vector<double> edges;
  const auto refuse = [&] {
    throw InputError("command line", 0, "--box", text, "must be two (3D: three) positive edges, as in 10,20");
  };
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    double edge = 0;
    const auto [stop, error] = std::from_chars(text.data() + at, text.data() + end, edge);
    if (error != std::errc{} || stop != text.data() + end || !std::isfinite(edge) || !(edge > 0)) refuse();
    edges.push_back(edge);
    at = end + 1;
  }
  if (edges.size() != 2 && edges.size() != 3) refuse();
  return edges;
}

using Files = std::vector<std::pair<std::string, std::string>>;  // path, content

template <int D>
Files files_of(const Packing<D>& packing, const std::string& path, std::int64_t step, double time) {
  if (path.ends_with(".csv"))
    return {{grains_csv_path(path), grains_csv(packing)}, {contacts_csv_path(path), contacts_csv(packing)}};
  if (path.ends_with(".dump"))
    return {{path, grains_dump(packing, step)}, {links_dump_path(path), links_dump(packing, step)}};
  if (path.ends_with(".xyz")) return {{path, extended_xyz(packing, time)}};
  if (path.ends_with(".net")) return {{path, network_text(packing)}};
  return {{path, vtk_polydata(packing, time)}};
}

// None of them is the packing that was read, nor the contacts beside it.
void write_all(const Files& files, const std::string& input) {
  FileRule rule;
  for (const std::string& read : {input, grains_csv_path(input), contacts_csv_path(input), links_dump_path(input)})
    rule.reads("INPUT", read);
  for (const auto& [path, content] : files) rule.writes("-o", path);
  rule.require();
  write_files_atomically(files);
}

}  // namespace

int convert_command(int argc, char** argv) {
  const Arguments arguments(
      argc, argv,
      {{"-o", "OUTPUT", ".h5, .vtp, .dump, .xyz, .net or .csv"},
       {"--box", "L1,L2[,L3]", "edges of the periodic cell of a file that has none"},
       {"--gap-tolerance", "LENGTH", "gap up to which grains of a list without contacts touch"}},
      {"INPUT -o OUTPUT", "Translates a packing; a foreign one (.csv, .dump, .net) becomes a state with .h5."});
  arguments.require_inputs(1, 1, "one packing");
  const std::string input_path = arguments.inputs()[0], output = arguments.required("-o");
  bool known = false;
  for (const char* end : {".h5", ".vtp", ".dump", ".xyz", ".net", ".csv"}) known = known || output.ends_with(end);
  if (!known) throw InputError("command line", 0, "-o", output, "must end in .h5, .vtp, .dump, .xyz, .net or .csv");
  PackingReading reading;
  if (const auto box = arguments.value("--box")) reading.box = parse_box(*box);
  reading.gap_tolerance = arguments.number("--gap-tolerance");
  if (reading.gap_tolerance && *reading.gap_tolerance < 0)
    throw InputError("command line", 0, "--gap-tolerance", *arguments.value("--gap-tolerance"), "must not be negative");

  FileRule rule;
  rule.reads("INPUT", input_path);
  rule.writes("-o", output);
  rule.require();
  const PackingFile file = read_packing(input_path, reading);
  if (!file.state.packing.beams.empty() && !output.ends_with(".net") && !output.ends_with(".vtp"))
    throw InputError(input_path, 0, "-o", output, "beams are kept by .net files only (and drawn in .vtp)");
  if (file.triangles) {
    const State<TriangleGrains>& state = *file.triangles;
    if (output.ends_with(".h5")) {
      if (const auto fault = state_fault(state))  // a network may have beams that no run can march
        throw InputError(input_path, 0, "-o", output,
                         "cannot be kept as a state: " + fault->field + ": " + fault->rule);
      write_state(state, output);
    } else if (output.ends_with(".net")) {
      write_files_atomically({{output, triangle_network_text(state.packing, file.corners)}});
    } else if (output.ends_with(".vtp")) {
      write_files_atomically({{output, vtk_polydata(state.packing, state.time)}});
    } else {
      throw InputError(input_path, 0, "-o", output, "triangles are kept by .h5 and .net files only (drawn in .vtp)");
    }
    return exit_done;
  }
  if (output.ends_with(".h5")) {
    if (file.packing_3d)
      write_state(file.spheres ? *file.spheres : foreign_state(*file.packing_3d), output);
    else
      write_state(file.state, output);
    return exit_done;
  }
  const State<Disks>& state = file.state;
  if (file.spheres && output.ends_with(".vtp")) {
    write_files_atomically({{output, vtk_polydata(file.spheres->packing, file.spheres->time)}});
    return exit_done;
  }
  if (file.spheres) {
    write_all(files_of(*file.packing_3d, output, file.spheres->step, file.spheres->time), input_path);
    return exit_done;
  }
  write_all(file.packing_3d ? files_of(*file.packing_3d, output, state.step, state.time)
                            : files_of(state.packing, output, state.step, state.time),
            input_path);
  return exit_done;
}

}  // namespace isostat
