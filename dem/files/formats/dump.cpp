#include "dem/files/formats/dump.hpp"

#include <algorithm>
#include <array>
#include <charconv>

#include "dem/files/formats/column_names.hpp"
#include "dem/files/formats/real_text.hpp"
#include "dem/files/formats/table_packing.hpp"
#include "dem/files/formats/text_lines.hpp"
#include "dem/state/joins_grains.hpp"

namespace isostat {
namespace {

void append(std::string& text, double value) { text += ' ', append_real(text, value); }
template <int D>
void append_vector(std::string& text, const Vec<D>& v) {
  for (int k = 0; k < 3; ++k) append(text, k < D ? v[k] : 0.0);
}
void append_spin(std::string& text, double spin) { append_vector<3>(text, {{0, 0, spin}}); }
void append_spin(std::string& text, const Vec3& spin) { append_vector(text, spin); }

template <int D>
std::string frame_header(const Packing<D>& packing, std::int64_t step, std::string_view items, std::size_t count) {
  std::string text = "ITEM: TIMESTEP\n" + std::to_string(step) + "\nITEM: NUMBER OF " + std::string(items) + "\n" +
                     std::to_string(count) + "\nITEM: BOX BOUNDS";
  const double tilt = packing.cell ? packing.cell->tilt : 0;
  if (tilt != 0) text += " xy xz yz";
  for (int k = 0; k < 3; ++k) text += packing.cell && k < D ? " pp" : k < D ? " ff" : " pp";
  text += '\n';
  for (int k = 0; k < 3; ++k) {
    double low = -0.5, high = 0.5;  // of the unused axis of a planar packing
    if (k < D && packing.cell) {
      low = 0, high = packing.cell->length[k];
      if (k == 0) low += std::min(0.0, tilt), high += std::max(0.0, tilt);  // of the box around the tilted cell
    } else if (k < D) {
      low = high = 0;
      for (std::size_t b = 0; b < packing.bodies.size(); ++b) {
        const double x = packing.bodies.position[b][k], r = packing.bodies.radius[b];
        low = b == 0 ? x - r : std::min(low, x - r);
        high = b == 0 ? x + r : std::max(high, x + r);
      }
    }
    append_real(text, low);
    append(text, high);
    if (tilt != 0) append(text, k == 0 ? tilt : 0.0);
    text += '\n';
  }
  return text;
}

double number_or_throw(std::string_view text, const std::string& path, int line, const char* key) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size())
    throw InputError(path, line, key, std::string(text), "must be a number");
  return value;
}

struct Box {
  std::array<double, 3> low{}, high{};
  std::array<bool, 3> periodic{};
  double tilt = 0;
};

// ITEM: BOX BOUNDS [xy xz yz] [pp pp pp]; with xy xz yz a line has a third number, the tilt.
Box parse_box(std::string_view item, Lines& lines, const std::string& path) {
  Box box;
  auto words = fields_of(item);
  words.erase(words.begin(), words.begin() + 3);
  if (!words.empty() && words[0] == "abc")
    throw InputError(path, lines.number(), "BOX BOUNDS", std::string(item),
                     "a cell of general edges is not read; LAMMPS writes that of the plane without triclinic/general");
  const bool tilted = words.size() >= 3 && words[0] == "xy" && words[1] == "xz" && words[2] == "yz";
  if (tilted) words.erase(words.begin(), words.begin() + 3);
  if (words.size() > 3)
    throw InputError(path, lines.number(), "BOX BOUNDS", std::string(item), "'pp pp pp' or 'xy xz yz pp pp pp'");
  for (std::size_t k = 0; k < 3; ++k) box.periodic[k] = words.size() == 3 && words[k] == "pp";
  for (std::size_t k = 0; k < 3; ++k) {
    std::string_view line;
    if (!lines.next(line))
      throw InputError(path, lines.number(), "BOX BOUNDS", "", "the file ends here; three lines follow");
    const auto f = fields_of(line);
    if (f.size() != (tilted ? 3 : 2))
      throw InputError(path, lines.number(), "BOX BOUNDS", std::string(line),
                       tilted ? "must be two numbers and a tilt" : "must be two numbers");
    box.low[k] = number_or_throw(f[0], path, lines.number(), "BOX BOUNDS");
    box.high[k] = number_or_throw(f[1], path, lines.number(), "BOX BOUNDS");
    if (!(box.high[k] > box.low[k]))
      throw InputError(path, lines.number(), "BOX BOUNDS", std::string(line), "must increase");
    const double tilt = tilted ? number_or_throw(f[2], path, lines.number(), "BOX BOUNDS") : 0;
    if (k == 0) box.tilt = tilt;
    if (k > 0 && tilt != 0)
      throw InputError(path, lines.number(), "BOX BOUNDS", std::string(line), "only xy may tilt a cell: xz = yz = 0");
  }
  box.low[0] -= std::min(0.0, box.tilt), box.high[0] -= std::max(0.0, box.tilt);
  if (!(box.high[0] > box.low[0]))
    throw InputError(path, lines.number(), "BOX BOUNDS", "xy", "the bounds of x are those of the tilted cell");
  return box;
}

// Scaled coordinates: column `from` times factor plus summand is column `to`, unless that is there.
void unscale(TextTable& table, const std::string& from, const std::string& to, double factor, double summand) {
  const auto col = table.column(from);
  if (!col || table.column(to)) return;
  table.columns[*col] = to;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    std::string_view& cell = table.cell(row, *col);
    const double value = number_or_throw(cell, table.path, table.lines[row], to.c_str());
    std::string text;
    append_real(text, value * factor + summand);
    table.owned.push_back(std::move(text));
    cell = table.owned.back();
  }
}
void rename(TextTable& table, const std::string& from, const std::string& to) {
  if (const auto col = table.column(from); col && !table.column(to)) table.columns[*col] = to;
}

}  // namespace

template <int D>
std::string grains_dump(const Packing<D>& packing, std::int64_t step) {
  const Bodies<D>& b = packing.bodies;
  std::string text = frame_header(packing, step, "ATOMS", packing.grains());
  text += "ITEM: ATOMS id type x y z radius vx vy vz omegax omegay omegaz mass\n";
  for (std::size_t k = 0; k < packing.grains(); ++k) {
    text += std::to_string(b.id[k]) + " 1";
    append_vector(text, b.position[k]);
    append(text, b.radius[k]);
    append_vector(text, b.velocity[k]);
    append_spin(text, b.spin[k]);
    append(text, b.mass[k]);
    text += '\n';
  }
  return text;
}

template <int D>
std::string links_dump(const Packing<D>& packing, std::int64_t step) {
  std::string text =
      frame_header(packing, step, "ENTRIES",
                   static_cast<std::size_t>(std::count_if(packing.links.begin(), packing.links.end(),
                                                          [&](const Link<D>& l) { return joins_grains(packing, l); })));
  text += D == 2 ? "ITEM: ENTRIES i j s1 s2 kind h N T M\n" : "ITEM: ENTRIES i j s1 s2 s3 kind h N Tx Ty Tz Mx My Mz\n";
  for (const Link<D>& l : packing.links) {
    if (!joins_grains(packing, l)) continue;
    text += std::to_string(packing.bodies.id[static_cast<std::size_t>(l.i)]) + ' ' +
            std::to_string(packing.bodies.id[static_cast<std::size_t>(l.j)]);
    for (const int s : l.shift) text += ' ' + std::to_string(s);
    text += ' ' + std::to_string(static_cast<int>(l.kind));
    append(text, l.gap);
    append(text, l.normal_force);
    if constexpr (D == 2) {
      append(text, l.tangential_force);
      append(text, l.moment);
    } else {
      append_vector(text, l.tangential_force);
      append_vector(text, l.moment);
    }
    text += '\n';
  }
  return text;
}

std::string links_dump_path(std::string_view path) {
  if (path.ends_with(".dump")) path.remove_suffix(5);
  return std::string(path) + ".contacts.dump";
}

DumpFrame parse_dump(std::string given, const std::string& path, const ColumnNames& named) {
  DumpFrame frame;
  TextTable& table = frame.table;
  table.path = path;
  const std::string& text = table.owned.emplace_back(std::move(given));
  Box box;
  Lines lines(text);
  std::string_view line;
  long long count = -1;
  const auto integer = [&](const char* key, auto& value) {
    const auto number = fields_of(line);
    const auto [end, error] = number.empty() ? std::from_chars_result{nullptr, std::errc::invalid_argument}
                                             : std::from_chars(number[0].data(), line.data() + line.size(), value);
    if (error != std::errc{} || number.size() != 1 || end != number[0].data() + number[0].size() || value < 0)
      throw InputError(path, lines.number(), key, std::string(line), "must be an integer, not negative");
  };
  while (lines.next(line)) {
    const auto words = fields_of(line);
    if (words.empty()) continue;
    if (words[0] != "ITEM:")
      throw InputError(path, lines.number(), "", std::string(line), "expected a line 'ITEM: ...'");
    const std::string_view item = words.size() > 1 ? words[1] : "";
    if (item == "TIME" || item == "UNITS") {
      lines.next(line);
    } else if (item == "TIMESTEP") {
      if (!lines.next(line)) break;
      integer("TIMESTEP", frame.step.emplace());
    } else if (item == "NUMBER") {
      if (!lines.next(line)) break;
      integer("NUMBER OF", count);
    } else if (item == "BOX" && words.size() > 2) {
      box = parse_box(line, lines, path);
    } else if (item == "ATOMS" || item == "ENTRIES") {
      table.header_line = lines.number();
      table.columns.assign(words.begin() + 2, words.end());
      table.cells.clear(), table.lines.clear();
      for (long long row = 0; row < count; ++row) {
        if (!lines.next(line))
          throw InputError(path, lines.number(), "", "",
                           "the file ends here; " + std::to_string(count - row) + " rows are missing");
        const auto f = fields_of(line);
        if (f.size() != table.columns.size())
          throw InputError(path, lines.number(), "", std::to_string(f.size()) + " fields",
                           "a row has as many fields as columns, " + std::to_string(table.columns.size()));
        table.cells.insert(table.cells.end(), f.begin(), f.end());
        table.lines.push_back(lines.number());
      }
    } else {
      throw InputError(path, lines.number(), "", std::string(line), "unknown item of a dump file");
    }
  }
  if (table.columns.empty()) throw InputError(path, 0, "", "", "has no 'ITEM: ATOMS' or 'ITEM: ENTRIES'");

  const std::array<std::string, 3> axes{"x", "y", "z"};
  for (std::size_t k = 0; k < 3; ++k) {
    const double edge = box.high[k] - box.low[k];
    if (box.tilt != 0 && (table.column(axes[k] + "s") || table.column(axes[k] + "su")))
      throw InputError(path, 0, axes[k] + "s", "", "scaled coordinates of a tilted cell; write x, y");
    rename(table, axes[k] + "u", axes[k]);
    unscale(table, axes[k] + "s", axes[k], edge, box.low[k]);
    unscale(table, axes[k] + "su", axes[k], edge, box.low[k]);
  }
  const int dimension = grain_dimension(table, named);
  const auto periodic = std::count(box.periodic.begin(), box.periodic.begin() + dimension, true);
  if (periodic != 0 && periodic != dimension)
    throw InputError(path, 0, "BOX BOUNDS", "", "a cell is periodic along all axes of the packing, or along none");
  if (periodic != 0) {
    frame.box.emplace();
    for (std::size_t k = 0; k < 3; ++k) frame.box->push_back(box.high[k] - box.low[k]);
    frame.tilt = box.tilt;
  }
  return frame;
}

template std::string grains_dump(const Packing<2>&, std::int64_t);
template std::string grains_dump(const Packing<3>&, std::int64_t);
template std::string links_dump(const Packing<2>&, std::int64_t);
template std::string links_dump(const Packing<3>&, std::int64_t);

}  // namespace isostat
