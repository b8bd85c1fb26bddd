#include "dem/files/formats/dump.hpp"

#include <algorithm>
#include <array>
#include <charconv>

#include "dem/files/formats/real_text.hpp"

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

std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> f;
  constexpr std::string_view space = " \t\r";
  for (std::size_t at = line.find_first_not_of(space); at != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(space, at), line.size());
    f.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(space, end);
  }
  return f;
}

// Lines of a text with their numbers.
class Lines {
 public:
  explicit Lines(std::string_view text) : text_(text) {}
  bool next(std::string_view& line) {
    if (at_ >= text_.size()) return false;
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    line = text_.substr(at_, end - at_);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    at_ = end + 1;
    ++number_;
    return true;
  }
  int number() const { return number_; }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
  int number_ = 0;
};

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

Box parse_box(std::string_view item, Lines& lines, const std::string& path) {
  Box box;
  auto words = fields_of(item);  // ITEM: BOX BOUNDS pp pp pp, of a tilted cell xy xz yz pp pp pp
  const bool tilted = words.size() == 9 && words[3] == "xy" && words[4] == "xz" && words[5] == "yz";
  if (tilted) words.erase(words.begin() + 3, words.begin() + 6);
  if (words.size() > 6)
    throw InputError(path, lines.number(), "BOX BOUNDS", std::string(item), "'pp pp pp' or 'xy xz yz pp pp pp'");
  for (std::size_t k = 0; k < 3; ++k) box.periodic[k] = words.size() == 6 && words[k + 3] == "pp";
  for (std::size_t k = 0; k < 3; ++k) {
    std::string_view line;
    if (!lines.next(line))
      throw InputError(path, lines.number(), "BOX BOUNDS", "", "the file ends here; three lines follow");
    const auto f = fields_of(line);
    if (f.size() != (tilted ? 3 : 2))
      throw InputError(path, lines.number(), "BOX BOUNDS", std::string(line),
                       tilted ? "must be three numbers" : "must be two numbers");
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

// A column of the table computed from another one, value * factor + summand.
void convert_column(DumpFrame& frame, std::string_view from, const std::string& to, double factor, double summand) {
  const auto col = frame.table.column(from);
  if (!col || frame.table.column(to)) return;
  frame.table.columns[*col] = to;
  if (factor == 1 && summand == 0) return;
  for (std::size_t row = 0; row < frame.table.rows(); ++row) {
    std::string_view& cell = frame.table.cells[row * frame.table.columns.size() + *col];
    const double value =
        number_or_throw(cell, frame.table.path, frame.table.first_line + static_cast<int>(row), to.c_str());
    std::string text;
    append_real(text, value * factor + summand);
    frame.owned.push_back(std::move(text));
    cell = frame.owned.back();
  }
}

}  // namespace

template <int D>
std::string grains_dump(const Packing<D>& packing, std::int64_t step) {
  const Bodies<D>& b = packing.bodies;
  std::string text = frame_header(packing, step, "ATOMS", b.size());
  text += "ITEM: ATOMS id type x y z radius vx vy vz omegax omegay omegaz mass\n";
  for (std::size_t k = 0; k < b.size(); ++k) {
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
  std::string text = frame_header(packing, step, "ENTRIES", packing.links.size());
  text += D == 2 ? "ITEM: ENTRIES i j s1 s2 kind h N T M\n" : "ITEM: ENTRIES i j s1 s2 s3 kind h N Tx Ty Tz Mx My Mz\n";
  for (const Link<D>& l : packing.links) {
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

DumpFrame parse_dump(std::string_view text, const std::string& path) {
  DumpFrame frame;
  frame.table.path = path;
  Box box;
  Lines lines(text);
  std::string_view line;
  long long count = -1;
  while (lines.next(line)) {
    const auto words = fields_of(line);
    if (words.empty()) continue;
    if (words[0] != "ITEM:")
      throw InputError(path, lines.number(), "", std::string(line), "expected a line 'ITEM: ...'");
    const std::string_view item = words.size() > 1 ? words[1] : "";
    if (item == "TIMESTEP" || item == "TIME" || item == "UNITS") {
      lines.next(line);
    } else if (item == "NUMBER") {
      if (!lines.next(line)) break;
      const auto number = fields_of(line);
      const auto [end, error] = number.empty() ? std::from_chars_result{nullptr, std::errc::invalid_argument}
                                               : std::from_chars(number[0].data(), line.data() + line.size(), count);
      if (error != std::errc{} || number.size() != 1 || end != number[0].data() + number[0].size() || count < 0)
        throw InputError(path, lines.number(), "NUMBER OF", std::string(line), "must be an integer, not negative");
    } else if (item == "BOX") {
      box = parse_box(line, lines, path);
    } else if (item == "ATOMS" || item == "ENTRIES") {
      frame.table.columns.assign(words.begin() + 2, words.end());
      frame.table.cells.clear();
      frame.table.first_line = lines.number() + 1;
      for (long long row = 0; row < count; ++row) {
        if (!lines.next(line))
          throw InputError(path, lines.number(), "", "",
                           "the file ends here; " + std::to_string(count - row) + " rows are missing");
        const auto f = fields_of(line);
        if (f.size() != frame.table.columns.size())
          throw InputError(path, lines.number(), "", std::to_string(f.size()) + " fields",
                           "a row has as many fields as columns, " + std::to_string(frame.table.columns.size()));
        frame.table.cells.insert(frame.table.cells.end(), f.begin(), f.end());
      }
    } else {
      throw InputError(path, lines.number(), "", std::string(line), "unknown item of a dump file");
    }
  }
  if (frame.table.columns.empty()) throw InputError(path, 0, "", "", "has no 'ITEM: ATOMS' or 'ITEM: ENTRIES'");

  const std::array<std::string, 3> axes{"x", "y", "z"};
  for (std::size_t k = 0; k < 3; ++k) {
    const double edge = box.high[k] - box.low[k];
    if (box.tilt != 0 && (frame.table.column(axes[k] + "s") || frame.table.column(axes[k] + "su")))
      throw InputError(path, 0, axes[k] + "s", "", "scaled coordinates of a tilted cell; write x, y");
    convert_column(frame, axes[k] + "u", axes[k], 1, 0);
    convert_column(frame, axes[k] + "s", axes[k], edge, box.low[k]);
    convert_column(frame, axes[k] + "su", axes[k], edge, box.low[k]);
  }
  convert_column(frame, "radius", "r", 1, 0);
  convert_column(frame, "diameter", "r", 0.5, 0);
  convert_column(frame, "mass", "m", 1, 0);
  const int dimension = grain_dimension(frame.table);
  if (dimension == 2) convert_column(frame, "omegaz", "omega", 1, 0);
  for (const std::string& a : axes) convert_column(frame, "omega" + a, "w" + a, 1, 0);
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
