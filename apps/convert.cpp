// isostat convert INPUT... -o OUTPUT: the output's extension names its format; several inputs make a film.
#include <algorithm>
#include <optional>

#include "apps/analysis_options.hpp"
#include "apps/arguments.hpp"
#include "apps/commands.hpp"
#include "apps/convert/film.hpp"
#include "apps/file_rule.hpp"
#include "dem/files/atomic_file.hpp"
#include "dem/files/formats/csv.hpp"
#include "dem/files/formats/dump.hpp"
#include "dem/files/formats/packing_header.hpp"
#include "dem/files/hand_over.hpp"
#include "dem/files/network_file.hpp"
#include "dem/files/packing_file.hpp"
#include "dem/files/state_file.hpp"
#include "dem/input_error.hpp"
#include "dem/triangles/network_file.hpp"
#include "dem/triangles/state_check.hpp"

namespace isostat {
namespace {

double unit(const Arguments& arguments, const char* name) {
  const double value = arguments.number(name).value_or(1);
  if (!(value > 0)) throw InputError("command line", 0, name, *arguments.value(name), "must be positive");
  return value;
}

PackingReading reading_of(const Arguments& arguments) {
  PackingReading reading;
  const AnalysisOptions given = reading_options(arguments);
  reading.box = given.box, reading.gap_tolerance = given.gap_tolerance;
  if (const auto columns = arguments.value("--columns")) reading.columns = parse_column_names(*columns);
  reading.contacts = arguments.value("--contacts").value_or("");
  reading.length = unit(arguments, "--length"), reading.force = unit(arguments, "--force");
  return reading;
}

// The state of --from with what the input says of its grains. Lengths of the state are those of --length.
template <class System>
State<System> moved(const State<System>& base, const std::string& input, PackingReading reading) {
  if (reading.gap_tolerance)
    throw InputError("command line", 0, "--gap-tolerance", "",
                     "with --from contacts are found by the law of the state");
  const std::vector<double>& radii = base.packing.bodies.radius;
  if (!radii.empty()) reading.radius = *std::max_element(radii.begin(), radii.end()) * reading.length;
  if (base.packing.cell) {
    reading.own_cell.emplace();
    for (const double edge : base.packing.cell->length.c) reading.own_cell->push_back(edge * reading.length);
    reading.own_tilt = base.packing.cell->tilt * reading.length;
  }
  const PackingFile file = read_packing(input, reading);
  if (file.format != PackingFormat::csv && file.format != PackingFormat::dump)
    throw InputError(input, 0, "--from", "", "takes grains from a table of text or a LAMMPS dump");
  if (!file.ids_given)
    throw InputError(input, 0, "id", "", "column is missing: grains go into a state by their ids (--from)");
  const MovedGrains brings{file.sizes_given, file.velocities_given, file.spins_given, file.links_given};
  if constexpr (System::dimension == 2) {
    if (file.packing_3d) throw InputError(input, 0, "--from", "", "is in space, and the state is in the plane");
    return hand_over(base, file.state.packing, brings, input);
  } else {
    if (!file.packing_3d) throw InputError(input, 0, "--from", "", "is in the plane, and the state is in space");
    return hand_over<Spheres>(base, *file.packing_3d, brings, input);
  }
}

int put_into_state(const std::string& from, const std::string& input, const PackingReading& reading,
                   const std::string& output) {
  if (!output.ends_with(".h5") && !output.ends_with(".h5.partial"))
    throw InputError("command line", 0, "-o", output, "with --from must end in .h5 or .h5.partial");
  const AnyState any = read_state(from);
  if (const auto* disks = std::get_if<State<Disks>>(&any))
    write_state(moved(*disks, input, reading), output);
  else if (const auto* spheres = std::get_if<State<Spheres>>(&any))
    write_state(moved(*spheres, input, reading), output);
  else
    throw InputError(from, 0, "--from", "", "must be a state of disks or spheres");
  return exit_done;
}

template <class System>
WrittenFiles files_of(const State<System>& state, const std::string& path) {
  const auto& packing = state.packing;
  const std::string header = header_text(state);
  if (path.ends_with(".csv"))
    return {{grains_csv_path(path), grains_csv(packing)},
            {contacts_csv_path(path), contacts_csv(packing)},
            {header_path(path), header}};
  if (path.ends_with(".net")) {
    const bool plain = state.time == 0 && header.find("[law]") == std::string::npos;
    return {{path, (plain ? "" : commented_header(header)) + network_text(packing)}};
  }
  return film_files({state}, path);
}

// None of them is the packing that was read, nor what lies beside it.
void write_all(const WrittenFiles& files, const std::vector<std::string>& inputs) {
  FileRule rule;
  for (const std::string& input : inputs)
    for (const std::string& read :
         {input, grains_csv_path(input), contacts_csv_path(input), links_dump_path(input), header_path(input)})
      rule.reads("INPUT", read);
  for (const auto& [path, content] : files) rule.writes("-o", path);
  rule.require();
  write_files_atomically(files);
}

AnyState state_of(PackingFile file, std::optional<long long> first_id) {
  AnyState any = std::move(file.state);
  if (file.triangles)
    any = std::move(*file.triangles);
  else if (file.spheres)
    any = std::move(*file.spheres);
  else if (file.packing_3d)
    any = foreign_state(std::move(*file.packing_3d));
  if (first_id)
    std::visit(
        [first_id](auto& state) {
          std::vector<std::int64_t>& id = state.packing.bodies.id;
          const std::int64_t before = id.empty() ? 0 : *std::min_element(id.begin(), id.end());
          for (std::int64_t& i : id) i += *first_id - before;
        },
        any);
  return any;
}

int convert_triangles(const PackingFile& file, const std::string& input, const std::string& output) {
  const State<TriangleGrains>& state = *file.triangles;
  if (output.ends_with(".h5")) {
    if (const auto fault = state_fault(state))  // a network may have beams that no run can march
      throw InputError(input, 0, "-o", output, "cannot be kept as a state: " + fault->field + ": " + fault->rule);
    write_state(state, output);
  } else if (output.ends_with(".net")) {
    write_files_atomically({{output, triangle_network_text(state.packing, file.corners)}});
  } else if (output.ends_with(".vtp") || output.ends_with(".pvd")) {
    write_all(film_files({state}, output), {input});
  } else {
    throw InputError(input, 0, "-o", output, "triangles are kept by .h5 and .net files only (drawn in .vtp and .pvd)");
  }
  return exit_done;
}

int convert_one(const std::string& input, const PackingReading& reading, const std::string& output,
                std::optional<long long> first_id) {
  PackingFile file = read_packing(input, reading);
  if (!file.state.packing.beams.empty() && !output.ends_with(".net") && !output.ends_with(".vtp"))
    throw InputError(input, 0, "-o", output, "beams are kept by .net files only (and drawn in .vtp)");
  if (file.triangles) {
    if (first_id) throw InputError(input, 0, "--first-id", "", "is for disks and spheres");
    return convert_triangles(file, input, output);
  }
  const AnyState any = state_of(std::move(file), first_id);
  if (const auto* spheres = std::get_if<State<Spheres>>(&any)) {
    if (output.ends_with(".h5"))
      write_state(*spheres, output);
    else
      write_all(files_of(*spheres, output), {input});
  } else {
    const auto& disks = std::get<State<Disks>>(any);
    if (output.ends_with(".h5"))
      write_state(disks, output);
    else
      write_all(files_of(disks, output), {input});
  }
  return exit_done;
}

int convert_film(const std::vector<std::string>& inputs, const PackingReading& reading, const std::string& output,
                 std::optional<long long> first_id) {
  if (!output.ends_with(".xyz") && !output.ends_with(".dump") && !output.ends_with(".pvd"))
    throw InputError("command line", 0, "-o", output, "of several inputs must end in .xyz, .dump or .pvd: a film");
  std::vector<AnyState> frames;
  for (const std::string& input : inputs) {
    frames.push_back(state_of(read_packing(input, reading), first_id));
    if (frames.back().index() != frames.front().index())
      throw InputError(input, 0, "INPUT", "", "is of another system than " + inputs.front());
  }
  write_all(film_files(frames, output), inputs);
  return exit_done;
}

}  // namespace

int convert_command(int argc, char** argv) {
  const Arguments arguments(
      argc, argv,
      {{"-o", "OUTPUT", ".h5, .vtp, .pvd, .dump, .xyz, .net or .csv"},
       {"--box", "L1,L2[,L3]", "edges of the periodic cell of a file that has none"},
       {"--gap-tolerance", "LENGTH", "gap up to which grains of a list without contacts touch"},
       {"--columns", "OURS=THEIRS,...", "which column of the file is meant: x=pos1,y=pos2,d=size,fx=c_1[3]"},
       {"--contacts", "FILE", "contacts of the grains: a table of text, or a dump local of LAMMPS"},
       {"--length", "LENGTH", "length of the file that becomes the unit, mostly the largest diameter"},
       {"--force", "FORCE", "force of the file that becomes the unit"},
       {"--first-id", "N", "number the grains from N on: LAMMPS takes no 0"},
       {"--from", "STATE", "put positions and velocities of INPUT into this state; the rest stays"}},
      {"INPUT... -o OUTPUT",
       "Translates a packing; a foreign one (.csv, .dump, .net) becomes a state with .h5. Several make a film (.pvd, "
       ".dump, .xyz)."});
  arguments.require_inputs(1, 1000000, "a packing, or several for a film");
  const std::vector<std::string>& inputs = arguments.inputs();
  const std::string output = arguments.required("-o");
  const auto from = arguments.value("--from");
  const bool known = std::any_of(kConvertedFormats.begin(), kConvertedFormats.end(),
                                 [&](std::string_view end) { return output.ends_with(end); });
  if (!known && !from)
    throw InputError("command line", 0, "-o", output, "must end in .h5, .vtp, .pvd, .dump, .xyz, .net or .csv");
  const PackingReading reading = reading_of(arguments);
  const auto first_id = arguments.integer("--first-id", 0, 1000000000);

  FileRule rule;
  for (const std::string& input : inputs) rule.reads("INPUT", input);
  if (from) rule.reads("--from", *from);
  if (!reading.contacts.empty()) rule.reads("--contacts", reading.contacts);
  rule.writes("-o", output);
  rule.require();
  if (inputs.size() > 1) {
    if (from || !reading.contacts.empty())
      throw InputError("command line", 0, from ? "--from" : "--contacts", "", "takes one INPUT");
    return convert_film(inputs, reading, output, first_id);
  }
  if (!from) return convert_one(inputs[0], reading, output, first_id);
  if (first_id) throw InputError("command line", 0, "--first-id", "", "with --from the ids are those of the state");
  return put_into_state(*from, inputs[0], reading, output);
}

}  // namespace isostat
