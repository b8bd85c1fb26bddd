#include "dem/triangles/network_file.hpp"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <map>
#include <tuple>
#include <unordered_map>

#include "dem/files/atomic_file.hpp"
#include "dem/files/network_file.hpp"
#include "dem/files/network_lines.hpp"
#include "dem/input_error.hpp"
#include "dem/state/beam.hpp"
#include "dem/state/lengths.hpp"
#include "dem/state/touching.hpp"
#include "dem/triangles/network_law.hpp"
#include "dem/triangles/overlap_at_rest.hpp"
#include "dem/triangles/touching_triangles.hpp"
#include "geometry/base/index.hpp"
#include "geometry/placed_sets.hpp"
#include "geometry/triangle_overlap.hpp"

namespace isostat {
namespace {

using network_lines::Fields;
using network_lines::number;

// Neighbours in a deformed grain overlap by a few per cent of their area, up to a seventh where their ends gape by a
// twentieth of the side; more is a mistake.
constexpr double kMostInnerOverlap = 0.25;

class TriangleParser {
 public:
  TriangleParser(const std::string& path, const std::optional<Vec2>& box) : path_(path) {
    if (box) file_.packing.cell = PeriodicCell<2>{*box}, has_cell_ = true;
  }

  TriangleNetworkFile parse(std::string_view text) {
    network_lines::each_line(text, [&](int line, const Fields& f) {
      if (f[0] == "cell")
        cell(line, f);
      else if (f[0] == "triangle")
        triangle(line, f);
      else if (f[0] == "beam")
        beam_lines_.push_back({line, f});
      else if (f[0] == "tilt")
        fault(line, "tilt", f.size() > 1 ? f[1] : "",
              "the cell of triangles stands upright; only one of disks or spheres tilts");
      else
        fault(line, "", f[0],
              f[0] == "grain" || f[0] == "contact"
                  ? "a network is of grains or of triangles, not of both; overlaps of triangles are found"
                  : "a line starts with cell, triangle or beam");
    });
    if (lines_.empty() && faults_.empty()) fault(0, "triangle", "", "the file has no triangle line");
    refuse_faults();
    make_bodies();
    refuse_faults();
    for (const auto& [line, fields] : beam_lines_) beam(line, fields);
    check_grains();
    refuse_faults();
    unwrap_grains();
    file_.packing.overlaps = overlaps_at_rest(file_.packing, file_.triangles, triangle_network_law());
    return std::move(file_);
  }

 private:
  struct Line {
    int line;
    std::int64_t id, grain;
    Triangle triangle;
  };

  void fault(int line, std::string key, std::string_view value, std::string rule) {
    if (faults_.size() < kMaxFaults)
      faults_.push_back({path_, line, std::move(key), std::string(value), std::move(rule)});
    else if (faults_.size() == kMaxFaults)
      faults_.push_back({path_, line, "", "", "more faults from here on are not listed"});
  }
  void refuse_faults() {
    if (!faults_.empty()) throw InputError(std::move(faults_));
  }

  void cell(int line, const Fields& f) {
    if (f.size() != 3) return fault(line, "cell", std::to_string(f.size() - 1) + " numbers", "cell L1 L2");
    if (has_cell_)
      return fault(line, "cell", "",
                   cell_line_ == 0 ? "the file has its own cell; leave --box out"
                                   : "given before in line " + std::to_string(cell_line_) + "; keep one");
    has_cell_ = true, cell_line_ = line;
    PeriodicCell<2> c;
    for (int k = 0; k < 2; ++k) {
      const auto v = number<double>(f[idx(k) + 1]);
      if (!v || !(*v > 0))
        fault(line, "cell.L" + std::to_string(k + 1), f[idx(k) + 1], "must be a positive finite number");
      c.length[k] = v.value_or(1);
    }
    file_.packing.cell = c;
  }

  void triangle(int line, const Fields& f) {
    if (f.size() != 9)
      return fault(line, "triangle", std::to_string(f.size() - 1) + " fields", "triangle ID GRAIN X0 Y0 X1 Y1 X2 Y2");
    Line t{line, 0, 0, {}};
    bool good = true;
    const auto integer = [&](std::size_t at, const char* key, std::int64_t& value) {
      const auto v = number<std::int64_t>(f[at]);
      if (!v) fault(line, key, f[at], "must be an integer"), good = false;
      value = v.value_or(0);
    };
    integer(1, "triangle.ID", t.id), integer(2, "triangle.GRAIN", t.grain);
    for (std::size_t k = 0; k < 6; ++k) {
      const auto v = number<double>(f[3 + k]);
      if (!v) {
        fault(line, std::string("triangle.") + "XY"[k % 2] + std::to_string(k / 2), f[3 + k],
              "must be a finite number");
        good = false;
      }
      t.triangle.corner[k / 2][static_cast<int>(k % 2)] = v.value_or(0);
    }
    if (!good) return;
    const auto [seen, fresh] = line_of_id_.try_emplace(t.id, line);
    if (!fresh)
      return fault(line, "triangle.ID", f[1],
                   "used before in line " + std::to_string(seen->second) + "; IDs are distinct");
    lines_.push_back(t);
  }

  // The grains in the order of their first lines, the triangles of each in the order of theirs.
  void make_bodies() {
    TrianglePacking& p = file_.packing;
    std::unordered_map<std::int64_t, std::int32_t> number_of;
    std::vector<std::int32_t> grain;
    for (const Line& l : lines_) {
      const auto [at, fresh] = number_of.try_emplace(l.grain, static_cast<std::int32_t>(p.grains.id.size()));
      if (fresh) p.grains.id.push_back(l.grain);
      grain.push_back(at->second);
    }
    std::vector<std::size_t> order(lines_.size());
    for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return grain[a] < grain[b]; });
    p.grains.part.assign(p.grains.size(), GrainPart::free);
    p.grains.radius.assign(p.grains.size(), 0);
    for (const std::size_t k : order) {
      while (p.grains.begin.size() <= idx(grain[k])) p.grains.begin.push_back(static_cast<std::int32_t>(line_.size()));
      add_body(lines_[k]);
    }
    p.grains.begin.push_back(static_cast<std::int32_t>(line_.size()));
    set_grain_radii();
    if (!faults_.empty()) return;
    require_lengths(p.cell, p.bodies, path_, std::nullopt, cell_line_);
    if (!p.cell) return;
    for (std::size_t b = 0; b < p.bodies.size(); ++b)
      for (int k = 0; k < 2; ++k)
        if (std::abs(p.bodies.position[b][k]) > 1e8 * p.cell->length[k])
          fault(line_[b], "triangle", std::to_string(p.bodies.id[b]), "lies more than 1e8 cells away from the cell");
  }

  void add_body(const Line& l) {
    TrianglePacking& p = file_.packing;
    Triangle t = l.triangle;
    if (signed_double(t) < 0) std::swap(t.corner[1], t.corner[2]);
    // The rule of grain templates (dem/triangles/grain_template.cpp); J = m (a^2 + b^2 + c^2) / 36.
    const Vec2 u = t.corner[1] - t.corner[0], v = t.corner[2] - t.corner[0], w = t.corner[2] - t.corner[1];
    const double squares = dot(u, u) + dot(v, v) + dot(w, w), doubled = signed_double(t);
    if (!(doubled > 8 * std::numeric_limits<double>::epsilon() * squares) || !std::isfinite(squares))
      fault(l.line, "triangle", std::to_string(l.id), "has no area (or is out of range)");
    const Vec2 centre = t.corner[0] + (1.0 / 3) * (u + v);
    std::array<Vec2, 3> about;
    double radius = 0;
    for (std::size_t k = 0; k < 3; ++k) about[k] = t.corner[k] - centre, radius = std::max(radius, norm(about[k]));
    const double mass = kNetworkDensity * doubled / 2;
    Bodies<2>& b = p.bodies;
    index_.emplace(l.id, static_cast<std::int32_t>(b.size()));
    b.id.push_back(l.id), b.position.push_back(centre), b.radius.push_back(radius);
    b.velocity.push_back({}), b.spin.push_back(0), b.mass.push_back(mass), b.inertia.push_back(mass * squares / 36);
    p.corner.push_back(about), p.angle.push_back(0);
    file_.triangles.push_back(t), line_.push_back(l.line);
  }
  static double signed_double(const Triangle& t) {
    const Vec2 u = t.corner[1] - t.corner[0], v = t.corner[2] - t.corner[0];
    return u[0] * v[1] - u[1] * v[0];
  }

  void set_grain_radii() {
    TrianglePacking& p = file_.packing;
    for (std::size_t g = 0; g < p.grains.size(); ++g) {
      const auto begin = idx(p.grains.begin[g]), end = idx(p.grains.begin[g + 1]);
      Vec2 mean{};
      for (std::size_t k = begin; k < end; ++k) mean += (1.0 / static_cast<double>(end - begin)) * p.bodies.position[k];
      double radius = 0;
      for (std::size_t k = begin; k < end; ++k)
        for (const Vec2& c : file_.triangles[k].corner) radius = std::max(radius, norm(c - mean));
      p.grains.radius[g] = radius * (1 + 1e-9);
    }
  }

  std::optional<std::int32_t> known(int line, const char* key, std::string_view text) {
    const auto id = number<std::int64_t>(text);
    const auto found = id ? index_.find(*id) : index_.end();
    if (found != index_.end()) return found->second;
    fault(line, key, text, id ? "no triangle line has this ID" : "must be an integer");
    return std::nullopt;
  }

  void beam(int line, const Fields& f) {
    TrianglePacking& p = file_.packing;
    if (f.size() != 3 && f.size() != 5)
      return fault(line, "beam", std::to_string(f.size() - 1) + " fields", "beam I J [S1 S2]");
    const auto i = known(line, "beam.I", f[1]), j = known(line, "beam.J", f[2]);
    bool good = i && j;
    Link<2> link;
    for (std::size_t k = 0; k + 3 < f.size(); ++k) {
      const auto s = number<int>(f[3 + k]);
      if (!s || std::abs(static_cast<double>(*s)) > 1e8)
        fault(line, "beam.S" + std::to_string(k + 1), f[3 + k], "must be an integer of at most 1e8"), good = false;
      else if (*s != 0 && !p.cell)
        fault(line, "beam.S" + std::to_string(k + 1), f[3 + k], "an image shift needs a cell line"), good = false;
      else
        link.shift[k] = *s;
    }
    if (!good) return;
    link.i = *i, link.j = *j, link.kind = LinkKind::beam;
    const Vec2 apart = p.bodies.position[idx(*j)] - p.bodies.position[idx(*i)];
    if (p.cell && f.size() == 3) link.shift = p.cell->nearest_image(apart);
    const std::string pair = std::string(f[1]) + " " + std::string(f[2]);
    if (link.i == link.j && link.shift == ImageShift<2>{})
      return fault(line, "beam", pair, "a beam cannot join a triangle to itself except through an image (S1 S2)");
    Vec2 chord = p.cell ? apart + p.cell->offset(link.shift) : apart;
    if (link.i > link.j) {  // as a run keeps them
      std::swap(link.i, link.j);
      for (int& shift : link.shift) shift = -shift;
      chord = Vec2{} - chord;
    }
    if (!(norm(chord) > 0)) return fault(line, "beam", pair, "the two centroids coincide: a beam needs a direction");
    const ImageShift<2> back{-link.shift[0], -link.shift[1]};
    const bool forward = link.i != link.j ? link.i < link.j : link.shift > back;
    const auto key = forward ? std::tuple(link.i, link.j, link.shift) : std::tuple(link.j, link.i, back);
    const auto [seen, fresh] = line_of_beam_.try_emplace(key, line);
    if (!fresh)
      return fault(line, "beam", pair,
                   "repeats line " + std::to_string(seen->second) + ": one line for each pair and image");
    if (grain_of_(link.i) == grain_of_(link.j)) {
      const Triangle &a = file_.triangles[idx(link.i)], b = image_of(file_.triangles[idx(link.j)], p.cell, link.shift);
      if (!share_an_edge(a, b))
        return fault(line, "beam", pair, "joins two triangles of one grain that share no edge, not even roughly");
    }
    link.beam = static_cast<std::int32_t>(p.beams.size());
    Beam beam = beam_at_rest(norm(chord));
    beam.rest_angle_i = beam.rest_angle_j = -std::atan2(chord[1], chord[0]);
    p.beams.push_back(beam);
    p.links.push_back(link);
  }
  std::size_t grain_of_(std::int32_t triangle) const {
    const auto& begin = file_.packing.grains.begin;
    return idx(std::upper_bound(begin.begin(), begin.end(), triangle) - begin.begin() - 1);
  }

  void check_grains() {
    const TrianglePacking& p = file_.packing;
    for (std::size_t g = 0; g < p.grains.size(); ++g)
      for (auto a = idx(p.grains.begin[g]); a < idx(p.grains.begin[g + 1]); ++a)
        for (auto b = idx(p.grains.begin[g]); b < a; ++b) {
          const double reach = p.bodies.radius[a] + p.bodies.radius[b];
          if (norm(p.bodies.position[a] - p.bodies.position[b]) > reach) continue;
          const double area = triangle_overlap(file_.triangles[a], file_.triangles[b]).area;
          if (area > kMostInnerOverlap * std::min(p.bodies.mass[a], p.bodies.mass[b]) / kNetworkDensity)
            fault(line_[a], "triangle", std::to_string(p.bodies.id[a]),
                  "overlaps the triangle of line " + std::to_string(line_[b]) +
                      ", of the same grain, by more than a quarter of its area");
        }
  }

  // A grain whose triangles stand in different images is brought together along its beams; one that winds round the
  // cell stays.
  void unwrap_grains() {
    TrianglePacking& p = file_.packing;
    if (!p.cell) return;
    PlacedSets<2> sets(p.bodies.size());
    for (const Link<2>& l : p.links) {
      if (grain_of_(l.i) != grain_of_(l.j)) continue;
      const auto [a, image_a] = sets.find(l.i);
      const auto [b, image_b] = sets.find(l.j);
      if (a != b) sets.absorb(a, b, {l.shift[0] + image_a[0] - image_b[0], l.shift[1] + image_a[1] - image_b[1]});
    }
    for (std::size_t k = 0; k < p.bodies.size(); ++k) {
      const auto shift = sets.find(static_cast<int>(k)).image;
      p.bodies.position[k] += p.cell->offset(shift);
      file_.triangles[k] = image_of(file_.triangles[k], p.cell, shift);
    }
    for (Link<2>& l : p.links) {
      const auto a = sets.find(l.i).image, b = sets.find(l.j).image;
      for (std::size_t k = 0; k < 2; ++k) l.shift[k] += a[k] - b[k];
    }
    set_grain_radii();
  }

  std::string path_;
  TriangleNetworkFile file_;
  std::vector<Fault> faults_;
  bool has_cell_ = false;
  int cell_line_ = 0;  // 0: of --box
  std::vector<Line> lines_;
  std::unordered_map<std::int64_t, int> line_of_id_;
  std::vector<std::pair<int, Fields>> beam_lines_;  // resolved once every triangle is known
  std::unordered_map<std::int64_t, std::int32_t> index_;
  std::vector<int> line_;  // of each body
  std::map<std::tuple<std::int32_t, std::int32_t, ImageShift<2>>, int> line_of_beam_;
};

}  // namespace

TriangleNetworkFile parse_triangle_network(std::string_view text, const std::string& path,
                                           const std::optional<Vec2>& box) {
  return TriangleParser(path, box).parse(text);
}

TriangleNetworkFile read_triangle_network(const std::string& path, const std::optional<Vec2>& box) {
  return parse_triangle_network(read_whole_file(path), path, box);
}

std::string triangle_network_text(const TrianglePacking& p, const std::vector<Triangle>& triangles) {
  std::string text;
  char buffer[64];
  const auto real = [&](double v) {
    text.append(buffer, static_cast<std::size_t>(std::snprintf(buffer, sizeof buffer, " %.17g", v)));
  };
  if (p.cell) {
    text += "cell";
    for (int k = 0; k < 2; ++k) real(p.cell->length[k]);
    text += '\n';
  }
  const std::vector<std::int32_t> grain = grain_of(p.grains);
  const auto held = [&](std::int32_t k) { return p.grains.part[idx(grain[idx(k)])] != GrainPart::free; };
  bool any = false;
  for (std::int32_t k = 0; k < static_cast<std::int32_t>(p.bodies.size()); ++k) {
    if (held(k)) continue;
    any = true;
    text += "triangle " + std::to_string(p.bodies.id[idx(k)]) + ' ' + std::to_string(p.grains.id[idx(grain[idx(k)])]);
    for (const Vec2& c : triangles[idx(k)].corner) real(c[0]), real(c[1]);
    text += '\n';
  }
  if (!any)
    throw InputError("network", 0, "triangle", "", "a network needs a triangle that is free; there are only walls");
  for (const Link<2>& l : p.links) {
    if (held(l.i) || held(l.j)) continue;
    text += "beam " + std::to_string(p.bodies.id[idx(l.i)]) + ' ' + std::to_string(p.bodies.id[idx(l.j)]);
    if (p.cell)
      for (const int s : l.shift) text += ' ' + std::to_string(s);
    text += '\n';
  }
  return text;
}

}  // namespace isostat
