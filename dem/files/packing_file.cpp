#include "dem/files/packing_file.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "dem/files/atomic_file.hpp"
#include "dem/files/formats/csv.hpp"
#include "dem/files/formats/dump.hpp"
#include "dem/files/formats/packing_header.hpp"
#include "dem/files/formats/table_packing.hpp"
#include "dem/files/formats/text_table.hpp"
#include "dem/files/network_file.hpp"
#include "dem/files/state_file.hpp"
#include "dem/files/state_seal.hpp"
#include "dem/input_error.hpp"
#include "dem/state/beam.hpp"
#include "dem/state/lengths.hpp"
#include "dem/state/link_ends.hpp"
#include "dem/state/state_check.hpp"
#include "dem/state/touching.hpp"
#include "dem/triangles/network_file.hpp"
#include "dem/triangles/network_law.hpp"
#include "dem/triangles/touching_triangles.hpp"

namespace isostat {
namespace {

// From the units of the file to those of --length and --force. Times and masses stay.
template <int D>
void rescale(Packing<D>& packing, double length, double force) {
  if (packing.cell) packing.cell->length = packing.cell->length / length, packing.cell->tilt /= length;
  Bodies<D>& b = packing.bodies;
  for (std::size_t k = 0; k < b.size(); ++k) {
    b.position[k] = b.position[k] / length, b.velocity[k] = b.velocity[k] / length;
    b.radius[k] /= length, b.inertia[k] /= length * length;
  }
  for (Link<D>& l : packing.links) {
    l.gap /= length, l.normal_force /= force;
    l.tangential_force = l.tangential_force / force, l.moment = l.moment / (force * length);
  }
  if (!packing.beams.empty()) throw std::logic_error("rescale: beams");
}

// What could not be kept as a state is refused: squares of lengths that overflow or vanish, say.
template <int D>
void set_packing(PackingFile& file, Packing<D> packing, const std::optional<PackingHeader>& header,
                 const std::string& path, const PackingReading& reading) {
  if (reading.length != 1 || reading.force != 1) {
    if (header || !packing.beams.empty())
      throw InputError(path, 0, reading.length != 1 ? "--length" : "--force", "",
                       header ? "the file says its units with its law; leave the option out"
                              : "beams have stiffnesses in units of their own");
    rescale(packing, reading.length, reading.force);
  }
  if (const auto fault = packing_fault(packing))
    throw InputError(path, 0, fault->field, "", fault->rule + "; check the units");
  if constexpr (D == 2) {
    file.state = foreign_state(std::move(packing));
    if (header) header->complete(file.state);
  } else {
    if (!header) {
      static_cast<Packing<3>&>(file.packing_3d.emplace()) = std::move(packing);
      return;
    }
    file.spheres = foreign_state(std::move(packing));
    header->complete(*file.spheres);
    file.packing_3d = file.spheres->packing;
  }
}

template <int D>
PeriodicCell<D> cell_of(const std::vector<double>& edges) {
  PeriodicCell<D> cell;
  for (std::size_t k = 0; k < D; ++k) cell.length[static_cast<int>(k)] = edges[k];
  return cell;
}

// Gives the packing the cell that the user wants, unless it has its own.
template <int D>
void set_box(Packing<D>& packing, const std::string& path, const PackingReading& reading) {
  if (!reading.box) return;
  std::string given;
  for (const double edge : *reading.box) given += (given.empty() ? "" : ",") + std::to_string(edge);
  if (packing.cell)
    throw InputError(path, 0, reading.box_name, given, "the file has its own cell; leave " + reading.box_name + " out");
  if (reading.box->size() != D)
    throw InputError(path, 0, reading.box_name, given, "needs " + std::to_string(D) + " edges for this file");
  packing.cell = cell_of<D>(*reading.box);
}

// A cell that cannot be meant: grains far outside it, or far larger than it.
template <int D>
void check_cell(const Packing<D>& packing, const std::string& path) {
  if (!packing.cell) return;
  for (int k = 0; k < D; ++k)
    if (!(packing.cell->length[k] > 0) || !std::isfinite(packing.cell->length[k]))
      throw InputError(path, 0, "cell", std::to_string(packing.cell->length[k]), "an edge must be positive and finite");
  constexpr double kMostImages = 1e8;  // shifts stay exact integers
  for (std::size_t i = 0; i < packing.bodies.size(); ++i)
    for (int k = 0; k < D; ++k)
      if (!(std::abs(packing.bodies.position[i][k]) <= kMostImages * packing.cell->length[k]))
        throw InputError(path, 0, "grain", std::to_string(packing.bodies.id[i]),
                         "lies more than 1e8 cells away from the cell");
}

template <int D>
void find_touching(Packing<D>& packing, const PackingReading& reading) {
  find_contacts(packing, reading.gap_tolerance.value_or(default_gap_tolerance(packing.bodies)));
}

template <int D>
void read_network_into(PackingFile& file, const std::string& path, const PackingReading& reading) {
  const std::string text = read_whole_file(path);
  NetworkFile<D> network = parse_network<D>(text, path, reading.gap_tolerance);
  file.links_given = network.links_given;
  const bool isolated = !network.packing.cell;
  set_box(network.packing, path, reading);
  if (reading.box && isolated) {
    check_cell(network.packing, path);
    require_lengths(network.packing.cell, network.packing.bodies, path, reading.gap_tolerance);
    // The file was read as isolated: with its cell the nearest images are meant, and more grains may touch.
    for (Link<D>& link : network.packing.links) {
      const auto i = static_cast<std::size_t>(link.i), j = static_cast<std::size_t>(link.j);
      const Bodies<D>& b = network.packing.bodies;
      link.shift = network.packing.cell->nearest_image(b.position[j] - b.position[i]);
      const double distance = norm(branch(network.packing, i, j, link.shift));
      if (link.kind == LinkKind::beam)
        network.packing.beams[static_cast<std::size_t>(link.beam)] = beam_at_rest(distance);
      else
        link.gap = distance - b.radius[i] - b.radius[j];
    }
    if (!file.links_given) find_touching(network.packing, reading);
  }
  set_packing(file, std::move(network.packing), header_in_comments(text, path), path, reading);
}

void read_triangles_into(PackingFile& file, const std::string& path, const PackingReading& reading) {
  std::optional<Vec2> box;
  if (reading.box && reading.box->size() != 2)
    throw InputError(path, 0, reading.box_name, "", "needs 2 edges for this file");
  if (reading.box) box = Vec2{{(*reading.box)[0], (*reading.box)[1]}};
  TriangleNetworkFile network = read_triangle_network(path, box);
  file.triangles = foreign_state(std::move(network.packing));
  file.corners = std::move(network.triangles);
}

void take(PackingFile& file, State<Disks> state) { file.state = std::move(state); }
void take(PackingFile& file, State<Spheres> state) {
  file.packing_3d = state.packing;
  file.spheres = std::move(state);
}
void take(PackingFile& file, State<TriangleGrains> state) {
  file.corners = placed_triangles(state.packing);
  file.triangles = std::move(state);
}

// What belongs to a table of grains.
struct BesideGrains {
  std::optional<TextTable> links;
  std::optional<std::vector<double>> cell;
  double tilt = 0;  // of that cell
  std::optional<PackingHeader> header;
};

template <int D>
void read_tables_into(PackingFile& file, const TextTable& grains, const BesideGrains& beside,
                      const PackingReading& reading) {
  Packing<D> packing;
  GrainColumns columns;
  packing.bodies = read_grains<D>(grains, reading.columns, reading.radius, &columns);
  file.ids_given = columns.ids, file.sizes_given = columns.sizes, file.velocities_given = columns.velocities,
  file.spins_given = columns.spins, file.densities_given = columns.densities;
  if (beside.cell) {
    if (beside.cell->size() < D)
      throw InputError(grains.path, 0, "cell", "", "needs " + std::to_string(D) + " edges for these grains");
    packing.cell = cell_of<D>(*beside.cell);
    packing.cell->tilt = beside.tilt;
  }
  set_box(packing, grains.path, reading);
  if (!packing.cell && reading.own_cell && reading.own_cell->size() == D) {
    packing.cell = cell_of<D>(*reading.own_cell);
    packing.cell->tilt = reading.own_tilt;
  }
  check_cell(packing, grains.path);
  require_lengths(packing.cell, packing.bodies, grains.path, reading.gap_tolerance);
  file.links_given = beside.links.has_value();
  if (beside.links)
    packing.links = read_links<D>(*beside.links, packing, reading.columns);
  else
    find_touching(packing, reading);
  set_packing(file, std::move(packing), beside.header, grains.path, reading);
}

void read_tables(PackingFile& file, const TextTable& grains, const BesideGrains& beside,
                 const PackingReading& reading) {
  for (const auto& [ours, theirs] : reading.columns)
    if (!beside.links && is_column_of(TableKind::contacts, ours))
      throw InputError(grains.path, 0, "--columns", ours + "=" + theirs,
                       "is a column of contacts, and there are none; --contacts FILE gives them");
  if (grain_dimension(grains, reading.columns) == 3)
    read_tables_into<3>(file, grains, beside, reading);
  else
    read_tables_into<2>(file, grains, beside, reading);
}

bool exists(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(path, ignored);
}

// The file of contacts that was named, or the one that lies beside the grains, if it is there.
std::string contacts_path(const PackingReading& reading, const std::string& grains, const std::string& beside) {
  if (!reading.contacts.empty()) return reading.contacts;
  return beside != grains && exists(beside) ? beside : "";
}

// Contacts of a table of text, or of a dump local.
DumpFrame read_contacts(const std::string& path, const PackingReading& reading) {
  std::string text = read_whole_file(path);
  if (text.starts_with("ITEM:")) return parse_dump(std::move(text), path, reading.columns);
  DumpFrame frame;
  frame.table = parse_table(std::move(text), path);
  return frame;
}

std::optional<PackingHeader> read_header(const std::string& grains) {
  const std::string path = header_path(grains);
  if (path == grains || !exists(path)) return std::nullopt;
  return PackingHeader(read_whole_file(path), path);
}

void read_csv(PackingFile& file, const std::string& path, const PackingReading& reading) {
  BesideGrains beside;
  if (const std::string links = contacts_path(reading, path, contacts_csv_path(path)); !links.empty())
    beside.links = read_contacts(links, reading).table;
  beside.header = read_header(path);
  if (beside.header && !reading.box) beside.cell = beside.header->cell(), beside.tilt = beside.header->tilt();
  read_tables(file, parse_table(read_whole_file(path), path), beside, reading);
}

void read_dump(PackingFile& file, const std::string& path, const PackingReading& reading) {
  BesideGrains beside;
  DumpFrame grains = parse_dump(read_whole_file(path), path, reading.columns);
  if (const std::string links = contacts_path(reading, path, links_dump_path(path)); !links.empty()) {
    DumpFrame frame = read_contacts(links, reading);
    if (frame.step && grains.step && *frame.step != *grains.step)
      throw InputError(links, 0, "TIMESTEP", std::to_string(*frame.step),
                       "is the last frame of the contacts; that of the grains is " + std::to_string(*grains.step));
    beside.links = std::move(frame.table);
  }
  beside.header = read_header(path);
  beside.cell = grains.box, beside.tilt = grains.tilt;
  read_tables(file, grains.table, beside, reading);
}

// Options that only tables, or only packings in units of their own, have a use for.
void refuse_options(const std::string& path, const PackingReading& reading, PackingFormat format, bool triangles) {
  const bool table = format == PackingFormat::csv || format == PackingFormat::dump;
  if (!table && !reading.columns.empty())
    throw InputError(path, 0, "--columns", "", "belongs to tables of text and dumps; this file has no columns");
  if (!table && !reading.contacts.empty())
    throw InputError(path, 0, "--contacts", reading.contacts, "belongs to tables of text and dumps");
  if ((format == PackingFormat::state || triangles) && (reading.length != 1 || reading.force != 1))
    throw InputError(path, 0, reading.length != 1 ? "--length" : "--force", "",
                     "the file has its units; leave the option out");
}

// X.csv may stand for X.grains.csv.
std::string existing_path(const std::string& path) {
  if (!exists(path) && path.ends_with(".csv") && exists(grains_csv_path(path))) return grains_csv_path(path);
  return path;
}

}  // namespace

PackingFormat sniff_packing_format(const std::string& path, bool columns_named) {
  const std::string bytes = first_bytes(existing_path(path), 4096);
  // Also other HDF5 files, damaged states and whatever is called .h5: the reader of states says what is wrong.
  if (begins_like_state(bytes) || bytes.starts_with("\x89HDF\r\n\x1a\n") || path.ends_with(".h5"))
    return PackingFormat::state;
  const bool is_text = bytes.find('\0') == std::string::npos;
  for (std::size_t at = 0; is_text && at < bytes.size();) {
    const std::size_t end = std::min(bytes.find('\n', at), bytes.size());
    const std::string line = bytes.substr(at, end - at);
    at = end + 1;
    const std::size_t first = line.find_first_not_of(" \t\r\v\f");
    if (first == std::string::npos || line[first] == '#') continue;
    const std::string word = line.substr(first, line.find_first_of(" \t\r,", first) - first);
    if (word == "cell" || word == "tilt" || word == "grain" || word == "contact" || word == "beam" ||
        word == "triangle")
      return PackingFormat::network;
    if (word == "ITEM:") return PackingFormat::dump;
    break;
  }
  // A network with a misspelt first line is told so by its own reader.
  if (path.ends_with(".net")) return PackingFormat::network;
  if (is_text && (columns_named || path.ends_with(".csv") || begins_like_table(bytes))) return PackingFormat::csv;
  throw InputError(path, 0, "", "",
                   is_text ? "is no state (HDF5), network (.net), LAMMPS dump or table of grains: such a table begins "
                             "with the names of its columns, x, y and r (or d, the diameter), split by commas, "
                             "semicolons, tabs or white space"
                           : "is no state (HDF5), network (.net), LAMMPS dump or table of grains; a damaged state must "
                             "be packed again");
}

PackingFile read_packing(const std::string& given_path, const PackingReading& reading) {
  const std::string path = existing_path(given_path);
  PackingFile file;
  file.format = sniff_packing_format(path, !reading.columns.empty());
  refuse_options(path, reading, file.format, false);
  switch (file.format) {
    case PackingFormat::state:
      if (reading.box)
        throw InputError(path, 0, reading.box_name, "", "a state has its own cell; leave " + reading.box_name + " out");
      std::visit(
          [&](auto&& state) {
            require_lengths(state.packing.cell, state.packing.bodies, path, reading.gap_tolerance);
            take(file, std::move(state));
          },
          read_state(path));
      file.links_given = true;
      break;
    case PackingFormat::network:
      switch (network_kind(path)) {
        case NetworkKind::plane:
          read_network_into<2>(file, path, reading);
          break;
        case NetworkKind::space:
          read_network_into<3>(file, path, reading);
          break;
        case NetworkKind::triangles:
          refuse_options(path, reading, file.format, true);
          read_triangles_into(file, path, reading);
          break;
      }
      break;
    case PackingFormat::dump:
      read_dump(file, path, reading);
      break;
    case PackingFormat::csv:
      read_csv(file, path, reading);
      break;
  }
  return file;
}

State<Disks> foreign_state(Packing<2> packing) {
  State<Disks> state;
  state.packing = std::move(packing);
  return state;
}

State<Spheres> foreign_state(Packing<3> packing) {
  State<Spheres> state;
  static_cast<Packing<3>&>(state.packing) = std::move(packing);
  state.scene.system = SceneSystem::spheres;
  return state;
}

State<TriangleGrains> foreign_state(TrianglePacking packing) {
  State<TriangleGrains> state;
  state.packing = std::move(packing);
  state.law = triangle_network_law();
  state.scene.system = SceneSystem::triangles;
  return state;
}

}  // namespace isostat
