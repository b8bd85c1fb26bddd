#include "dem/files/network_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <unordered_map>

#include "dem/files/atomic_file.hpp"
#include "dem/files/formats/table_packing.hpp"
#include "dem/files/network_lines.hpp"
#include "dem/input_error.hpp"
#include "dem/state/beam.hpp"
#include "dem/state/lengths.hpp"
#include "dem/state/link_ends.hpp"
#include "dem/state/touching.hpp"

namespace isostat {
namespace {

using network_lines::Fields;
using network_lines::number;

template <int D>
class NetworkParser {
 public:
  explicit NetworkParser(const std::string& path) : path_(path) {}

  NetworkFile<D> parse(std::string_view text, std::optional<double> gap_tolerance) {
    network_lines::each_line(text, [&](int line, const Fields& f) {
      if (f[0] == "cell")
        cell(line, f);
      else if (f[0] == "tilt")
        tilt(line, f);
      else if (f[0] == "grain")
        grain(line, f);
      else if (f[0] == "contact" || f[0] == "beam")
        links_.push_back({line, f});
      else
        fault(line, "", f[0],
              f[0] == "triangle"
                  ? "a network is of grains or of triangles, not of both"
                  : "a line starts with cell, tilt, grain, contact or beam, or with triangle in a network of "
                    "triangles");
    });
    place_tilt();
    check_placement();
    for (const auto& [at, fields] : links_) {
      const bool is_beam = fields[0] == "beam";
      file_.links_given = file_.links_given || !is_beam;
      is_beam ? beam(at, fields) : contact(at, fields);
    }
    if (file_.packing.bodies.size() == 0 && faults_.empty()) fault(0, "grain", "", "the file has no grain line");
    if (!faults_.empty()) throw InputError(std::move(faults_));
    require_lengths(file_.packing.cell, file_.packing.bodies, path_, gap_tolerance, cell_line_);

    file_.packing.bodies.resize(file_.packing.bodies.size());
    set_equal_densities(file_.packing.bodies);
    if (!file_.links_given)
      find_contacts(file_.packing, gap_tolerance.value_or(default_gap_tolerance(file_.packing.bodies)));
    return std::move(file_);
  }

 private:
  void fault(int line, std::string key, std::string_view value, std::string rule) {
    if (faults_.size() < kMaxFaults)
      faults_.push_back({path_, line, std::move(key), std::string(value), std::move(rule)});
    else if (faults_.size() == kMaxFaults)
      faults_.push_back({path_, line, "", "", "more faults from here on are not listed"});
  }

  std::optional<double> real(int line, const std::string& key, std::string_view text, bool positive) {
    const auto value = number<double>(text);
    if (value && (!positive || *value > 0)) return value;
    fault(line, key, text, positive ? "must be a positive finite number" : "must be a finite number");
    return std::nullopt;
  }

  void cell(int line, const Fields& f) {
    if (f.size() != D + 1)
      return fault(line, "cell", std::to_string(f.size() - 1) + " numbers", D == 2 ? "cell L1 L2" : "cell L1 L2 L3");
    if (cell_line_ > 0)
      return fault(line, "cell", "", "given before in line " + std::to_string(cell_line_) + "; keep one");
    cell_line_ = line;
    PeriodicCell<D> c;
    bool good = true;
    for (int k = 0; k < D; ++k) {
      const auto v = real(line, "cell.L" + std::to_string(k + 1), f[static_cast<std::size_t>(k) + 1], true);
      good = good && v;
      c.length[k] = v.value_or(1);
    }
    has_cell_ = true;
    if (good) file_.packing.cell = c;
  }

  void tilt(int line, const Fields& f) {
    if (f.size() != 2) return fault(line, "tilt", std::to_string(f.size() - 1) + " numbers", "tilt T");
    if (tilt_line_ > 0)
      return fault(line, "tilt", "", "given before in line " + std::to_string(tilt_line_) + "; keep one");
    tilt_line_ = line, tilt_ = real(line, "tilt", f[1], false).value_or(0);
  }
  void place_tilt() {
    if (tilt_line_ == 0) return;
    if (!has_cell_) fault(tilt_line_, "tilt", "", "needs a cell line");
    if (file_.packing.cell) file_.packing.cell->tilt = tilt_;
  }

  void grain(int line, const Fields& f) {
    if (f.size() != D + 3)
      return fault(line, "grain", std::to_string(f.size() - 1) + " fields",
                   D == 2 ? "grain ID X Y R" : "grain ID X Y Z R");
    const auto id = number<std::int64_t>(f[1]);
    if (!id) fault(line, "grain.ID", f[1], "must be an integer");
    Vec<D> r;
    bool good = id.has_value();
    for (int k = 0; k < D; ++k) {
      const auto v = real(line, std::string("grain.") + "XYZ"[k], f[static_cast<std::size_t>(k) + 2], false);
      good = good && v;
      r[k] = v.value_or(0);
    }
    const auto radius = real(line, "grain.R", f[D + 2], true);
    if (id) {
      const auto [seen, fresh] = index_.try_emplace(*id, static_cast<std::int32_t>(file_.packing.bodies.size()));
      if (!fresh) {
        fault(line, "grain.ID", f[1],
              "used before in line " + std::to_string(line_of_grain_[static_cast<std::size_t>(seen->second)]) +
                  "; IDs are distinct");
        return;
      }
    }
    // A faulty grain keeps its index so that contacts to it are not reported as unknown; the file is refused anyway.
    if (!id) return;
    Bodies<D>& b = file_.packing.bodies;
    b.id.push_back(*id);
    b.position.push_back(r);
    b.radius.push_back(good && radius ? *radius : 1.0);
    line_of_grain_.push_back(line);
  }

  // Image numbers must fit an int with room for sums.
  void check_placement() {
    if (!file_.packing.cell) return;
    for (std::size_t i = 0; i < file_.packing.bodies.size(); ++i)
      for (int k = 0; k < D; ++k) {
        const double images = std::abs(file_.packing.bodies.position[i][k]) / file_.packing.cell->length[k];
        if (images > 1e8)
          fault(line_of_grain_[i], std::string("grain.") + "XYZ"[k], "", "lies more than 1e8 cells away from the cell");
      }
  }

  void contact(int line, const Fields& f) {
    if (f.size() != 4 && f.size() != D + 4)
      return fault(line, "contact", std::to_string(f.size() - 1) + " fields",
                   D == 2 ? "contact I J TYPE [S1 S2]" : "contact I J TYPE [S1 S2 S3]");
    const auto kind = link_kind_from_letters(f[3]);
    if (!kind) fault(line, "contact.TYPE", f[3], "one of c, s, r, sr, d");
    const auto ends = ends_of_link(line, f, 4);
    if (ends && kind) add_link(line, "contact", *ends, *kind);
  }

  void beam(int line, const Fields& f) {
    if constexpr (D == 3) return fault(line, "beam", "", "beams join grains of the plane; this network is in space");
    if (f.size() != 3 && f.size() != D + 3)
      return fault(line, "beam", std::to_string(f.size() - 1) + " fields", "beam I J [S1 S2]");
    if (const auto ends = ends_of_link(line, f, 3)) add_link(line, "beam", *ends, LinkKind::beam);
  }

  // Bodies and image of a link line; shifts, if any, stand from field `first_shift` on.
  struct Ends {
    std::int32_t i, j;
    ImageShift<D> shift;
  };
  std::optional<Ends> ends_of_link(int line, const Fields& f, std::size_t first_shift) {
    const std::string key(f[0]);
    const auto i = known_grain(line, key + ".I", f[1]), j = known_grain(line, key + ".J", f[2]);
    bool good = i && j;
    ImageShift<D> shift{};
    const bool given = f.size() > first_shift;
    for (std::size_t k = 0; given && k < D; ++k) {
      const std::string shift_key = key + ".S" + std::to_string(k + 1);
      const std::string_view text = f[first_shift + k];
      const auto s = number<int>(text);
      if (!s || std::abs(static_cast<double>(*s)) > 1e8) {
        fault(line, shift_key, text, "must be an integer of at most 1e8");
        good = false;
      } else if (*s != 0 && !has_cell_) {
        fault(line, shift_key, text, "an image shift needs a cell line");
        good = false;
      } else {
        shift[k] = *s;
      }
    }
    if (!good || (has_cell_ && !file_.packing.cell)) return std::nullopt;
    const auto& position = file_.packing.bodies.position;
    if (has_cell_ && !given)
      shift = file_.packing.cell->nearest_image(position[static_cast<std::size_t>(*j)] -
                                                position[static_cast<std::size_t>(*i)]);
    return Ends{*i, *j, shift};
  }

  std::optional<std::int32_t> known_grain(int line, const std::string& key, std::string_view text) {
    const auto id = number<std::int64_t>(text);
    if (!id) {
      fault(line, key, text, "must be an integer");
      return std::nullopt;
    }
    const auto found = index_.find(*id);
    if (found != index_.end()) return found->second;
    fault(line, key, text, "no grain line has this ID");
    return std::nullopt;
  }

  void add_link(int line, const std::string& word, const Ends& ends, LinkKind kind) {
    const Bodies<D>& b = file_.packing.bodies;
    const auto [i, j, shift] = ends;
    const auto ui = static_cast<std::size_t>(i), uj = static_cast<std::size_t>(j);
    const bool is_beam = kind == LinkKind::beam;
    const std::string pair = std::to_string(b.id[ui]) + " " + std::to_string(b.id[uj]);
    if (i == j && shift == ImageShift<D>{})
      return fault(line, word, pair,
                   std::string(is_beam ? "a beam cannot join a grain to itself" : "a grain cannot touch itself") +
                       " except through an image (S1 S2)");
    const double distance = norm(branch(file_.packing, ui, uj, shift));
    if (!(distance > 0) || !std::isfinite(distance))
      return fault(line, word, pair, "the two centres coincide (or are out of range): no normal direction");

    ImageShift<D> back;
    for (std::size_t k = 0; k < D; ++k) back[k] = -shift[k];
    const bool forward = i != j ? i < j : shift > back;
    const auto key = forward ? Key{i, j, shift, is_beam} : Key{j, i, back, is_beam};
    const auto [seen, fresh] = lines_.try_emplace(key, line, kind);
    if (!fresh)
      return fault(line, word, pair,
                   (seen->second.second == kind ? "repeats" : "contradicts") + std::string(" line ") +
                       std::to_string(seen->second.first) + ": one line for each pair and image");
    Link<D> link;
    link.i = i, link.j = j, link.shift = shift, link.kind = kind;
    if (is_beam) {
      link.beam = static_cast<std::int32_t>(file_.packing.beams.size());
      file_.packing.beams.push_back(beam_at_rest(distance));
    } else {
      link.gap = distance - b.radius[ui] - b.radius[uj];
    }
    file_.packing.links.push_back(link);
  }

  struct Key {
    std::int32_t i, j;
    ImageShift<D> shift;
    bool beam;
    bool operator==(const Key&) const = default;
  };
  struct KeyHash {
    std::size_t operator()(const Key& k) const {
      std::uint64_t h = static_cast<std::uint32_t>(k.i);
      const auto mix = [&h](std::uint64_t x) { h = (h ^ x) * 0x9E3779B97F4A7C15ull, h ^= h >> 29; };
      mix(static_cast<std::uint32_t>(k.j)), mix(k.beam);
      for (int s : k.shift) mix(static_cast<std::uint32_t>(s));
      return h;
    }
  };

  std::string path_;
  NetworkFile<D> file_;
  std::vector<Fault> faults_;
  int cell_line_ = 0, tilt_line_ = 0;
  double tilt_ = 0;
  bool has_cell_ = false;
  std::unordered_map<std::int64_t, std::int32_t> index_;  // of an ID
  std::vector<int> line_of_grain_;
  std::vector<std::pair<int, Fields>> links_;  // lines of contacts and beams, resolved once every grain is known
  std::unordered_map<Key, std::pair<int, LinkKind>, KeyHash> lines_;
};

}  // namespace

template <int D>
NetworkFile<D> parse_network(std::string_view text, const std::string& path, std::optional<double> gap_tolerance) {
  return NetworkParser<D>(path).parse(text, gap_tolerance);
}

template <int D>
NetworkFile<D> read_network(const std::string& path, std::optional<double> gap_tolerance) {
  return parse_network<D>(read_whole_file(path), path, gap_tolerance);
}

NetworkKind network_kind(const std::string& path) {
  std::optional<NetworkKind> kind;
  network_lines::each_line(read_whole_file(path), [&](int, const Fields& f) {
    if (kind) return;
    if (f[0] == "triangle") kind = NetworkKind::triangles;
    if (f[0] == "grain") kind = f.size() == 6 ? NetworkKind::space : NetworkKind::plane;
  });
  return kind.value_or(NetworkKind::plane);
}

namespace {

template <int D>
void refuse_other_beam(const Packing<D>& packing, const Link<D>& link) {
  const double length = norm(ends(packing, link).branch);
  const bool loaded = link.normal_force != 0 || link.tangential_force != Tangential<D>{} || link.moment != Spin<D>{};
  if (loaded || packing.beams[static_cast<std::size_t>(link.beam)] != beam_at_rest(length))
    throw InputError("network", 0, "beam",
                     std::to_string(packing.bodies.id[static_cast<std::size_t>(link.i)]) + " " +
                         std::to_string(packing.bodies.id[static_cast<std::size_t>(link.j)]),
                     "a .net file has no column for the load of a beam or a stiffness of its own");
}

}  // namespace

template <int D>
std::string network_text(const Packing<D>& packing) {
  if (!packing.feet.empty())
    throw InputError("network", 0, "contact", "", "a .net file has no place for contacts with smooth walls");
  std::string text;
  char buffer[64];
  const auto real = [&](double v) {
    text.append(buffer, static_cast<std::size_t>(std::snprintf(buffer, sizeof buffer, " %.17g", v)));
  };
  if (packing.cell) {
    text += "cell";
    for (int k = 0; k < D; ++k) real(packing.cell->length[k]);
    text += '\n';
    if (packing.cell->tilt != 0) text += "tilt", real(packing.cell->tilt), text += '\n';
  }
  const Bodies<D>& b = packing.bodies;
  for (std::size_t i = 0; i < b.size(); ++i) {
    text += "grain " + std::to_string(b.id[i]);
    for (int k = 0; k < D; ++k) real(b.position[i][k]);
    real(b.radius[i]);
    text += '\n';
  }
  for (const Link<D>& link : packing.links) {
    const bool is_beam = link.kind == LinkKind::beam;
    if (is_beam) refuse_other_beam(packing, link);
    text += std::string(is_beam ? "beam " : "contact ") + std::to_string(b.id[static_cast<std::size_t>(link.i)]) + ' ' +
            std::to_string(b.id[static_cast<std::size_t>(link.j)]);
    if (!is_beam) text += ' ' + std::string(letters(link.kind));
    if (packing.cell)
      for (int s : link.shift) text += ' ' + std::to_string(s);
    text += '\n';
  }
  return text;
}

template <int D>
void write_network(const std::string& path, const Packing<D>& packing) {
  write_file_atomically(path, network_text(packing));
}

template NetworkFile<2> parse_network(std::string_view, const std::string&, std::optional<double>);
template NetworkFile<3> parse_network(std::string_view, const std::string&, std::optional<double>);
template NetworkFile<2> read_network(const std::string&, std::optional<double>);
template NetworkFile<3> read_network(const std::string&, std::optional<double>);
template std::string network_text(const Packing<2>&);
template std::string network_text(const Packing<3>&);
template void write_network(const std::string&, const Packing<2>&);
template void write_network(const std::string&, const Packing<3>&);

}  // namespace isostat
