#include "dem/triangles/grain_store.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "dem/triangles/at_rest.hpp"
#include "dem/triangles/kernel/rows.hpp"
#include "geometry/base/index.hpp"

namespace isostat {
namespace {

constexpr double kGrowth = 1.25;  // of a circle that a grain has outgrown
constexpr double kFar = 1e3;      // [cm] between the two triangles of a padding pair, and from everything else

}  // namespace

void GrainStore::load(const TrianglePacking& p, const TriangleLaw& law, const TriangleMemory& m) {
  const Grains& g = p.grains;
  id = g.id, part_ = g.part, radius_ = g.radius, inverse_length_ = inverse_lengths(p, law);
  listed_ = listed_grains(p);

  const std::vector<std::int32_t> grain = grain_of(g);
  std::vector<std::vector<std::size_t>> links(g.size());
  for (std::size_t l = 0; l < p.links.size(); ++l) links[idx(grain[idx(p.links[l].i)])].push_back(l);
  std::vector<Topology> of(g.size());
  for (std::size_t k = 0; k < g.size(); ++k) {
    of[k] = {static_cast<std::uint16_t>(g.begin[k + 1] - g.begin[k]), part_[k] != GrainPart::free, {}};
    for (const std::size_t l : links[k])
      of[k].joined.push_back({static_cast<std::uint16_t>(p.links[l].i - g.begin[k]),
                              static_cast<std::uint16_t>(p.links[l].j - g.begin[k])});
  }
  topologies_ = of;
  std::sort(topologies_.begin(), topologies_.end(),
            [](const Topology& s, const Topology& t) { return s.driven != t.driven ? t.driven : s < t; });
  topologies_.erase(std::unique(topologies_.begin(), topologies_.end()), topologies_.end());
  topology_.resize(g.size());
  for (std::size_t k = 0; k < g.size(); ++k) topology_[k] = &*std::find(topologies_.begin(), topologies_.end(), of[k]);
  lay_out();

  const bool verlet = !m.half_velocity.empty(), gear = !m.derivatives.empty();
  std::size_t wall = 0;
  for (std::size_t k = 0; k < g.size(); ++k) {
    for (std::size_t t = 0; t < triangles(k); ++t) {
      const std::size_t n = idx(g.begin[k]) + t, s = slot(k, t);
      const auto set = [&](Column c, double value) { column_[c][s] = value; };
      const Bodies<2>& b = p.bodies;
      const Vec2 v = b.velocity[n], u = verlet ? m.half_velocity[n] : v;
      const double w = b.spin[n], h = verlet ? m.half_spin[n] : w;
      body_id[s] = b.id[n];
      set(x, b.position[n][0]), set(y, b.position[n][1]), set(angle, p.angle[n]);
      set(ux, u[0]), set(uy, u[1]), set(uw, h), set(px, v[0]), set(py, v[1]), set(pw, w);
      if (verlet) set(fx, m.force[n][0]), set(fy, m.force[n][1]), set(torque, m.torque[n]);
      set(mass, b.mass[n]), set(inertia, b.inertia[n]);
      set(inverse_mass, driven(k) ? 0 : 1 / b.mass[n]), set(inverse_inertia, driven(k) ? 0 : 1 / b.inertia[n]);
      set(reach, b.radius[n]), set(heavy, driven(k) ? 0 : 1);
      for (std::size_t c = 0; c < 3; ++c)
        column_[corner0 + 2 * c][s] = p.corner[n][c][0], column_[corner0 + 2 * c + 1][s] = p.corner[n][c][1];
      if (gear) {
        set(bx, m.derivatives[n][0][0]), set(by, m.derivatives[n][0][1]), set(bw, m.spin_derivatives[n][0]);
        set(cx, m.derivatives[n][1][0]), set(cy, m.derivatives[n][1][1]), set(cw, m.spin_derivatives[n][1]);
      }
      if (!m.candidate_position.empty())
        set(built_x, m.candidate_position[n][0]), set(built_y, m.candidate_position[n][1]),
            set(built_angle, m.candidate_angle[n]);
      if (driven(k)) {
        const bool known = wall < m.wall_position.size();
        set(wall_x, known ? m.wall_position[wall][0] : b.position[n][0]);
        set(wall_y, known ? m.wall_position[wall][1] : b.position[n][1]);
        set(wall_angle, known ? m.wall_angle[wall] : p.angle[n]);
        ++wall;
      }
    }
    for (std::size_t b = 0; b < beams(k); ++b)
      set_beam(beam_place(k, b), p.beams[idx(p.links[links[k][b]].beam)], law.damping);
  }
  fill_padding();
}

void GrainStore::set_beam(std::size_t place, const Beam& b, double gamma) {
  const Vec2 i = rest_direction(b.rest_angle_i), j = rest_direction(b.rest_angle_j);
  const auto set = [&](BeamColumn c, double value) { beam_column_[c][place] = value; };
  set(length, b.rest_length), set(rest_i, b.rest_angle_i), set(rest_j, b.rest_angle_j);
  set(xi, i[0]), set(yi, i[1]), set(xj, j[0]), set(yj, j[1]);
  set(stretching, b.stiffness), set(bending_stiffness, b.bending), set(bending, b.bending / b.rest_length);
  set(damping, gamma), set(bending_damping, gamma * (b.bending / b.stiffness) / b.rest_length);
}
Beam GrainStore::beam_at(std::size_t place) const {
  return {beam_column_[length][place], beam_column_[rest_i][place], beam_column_[rest_j][place],
          beam_column_[stretching][place], beam_column_[bending_stiffness][place]};
}

void GrainStore::lay_out() {
  std::vector<std::vector<std::size_t>> members(topologies_.size());
  for (std::size_t g = 0; g < grains(); ++g)
    members[static_cast<std::size_t>(topology_[g] - topologies_.data())].push_back(g);
  blocks_.clear();
  slot_.assign(grains(), 0), beam_slot_.assign(grains(), 0);
  slots_ = beam_slots_ = free_slots_ = most_work_ = 0;
  for (std::size_t t = 0; t < topologies_.size(); ++t) {
    const Topology& topology = topologies_[t];
    const std::size_t b = topology.joined.size();
    for (std::size_t first = 0; first < members[t].size(); first += kStride) {
      blocks_.push_back({static_cast<std::uint32_t>(slots_), static_cast<std::uint32_t>(beam_slots_),
                         topology.triangles, static_cast<std::uint16_t>(b), topology.joined.data()});
      for (std::size_t l = 0; l < kStride && first + l < members[t].size(); ++l)
        slot_[members[t][first + l]] = slots_ + l, beam_slot_[members[t][first + l]] = beam_slots_ + l;
      slots_ += kStride * topology.triangles, beam_slots_ += kStride * b;
    }
    if (!topology.driven) free_slots_ = slots_;
    most_work_ = std::max(most_work_, kStride * (4 * std::size_t{topology.triangles} + 2 * b));
  }
  for (auto& c : column_) c.assign(slots_, 0.0);
  for (auto& c : beam_column_) c.assign(beam_slots_, 0.0);
  body_id.assign(slots_, -1);
  rows.assign((slots_ + 2 * kPads) * kernel::kCornerRow, 0.0);
  loads.assign((slots_ + 2 * kPads) * kernel::kLoadRow, 0.0);
  for (std::size_t k = 0; k < 2 * kPads; ++k) {
    double* row = rows.data() + (slots_ + k) * kernel::kCornerRow;
    const double far = kFar * static_cast<double>(1 + k % 2);
    row[0] = far, row[1] = far, row[2] = far + 1, row[3] = far, row[4] = far, row[5] = far + 1;
  }
}

// Lanes without a grain have the shape of the block's first one, without weight, mass and stiffness: they add zeros.
void GrainStore::fill_padding() {
  for (const GrainBlock& block : blocks_)
    for (std::size_t l = 1; l < kStride; ++l) {
      if (body_id[block.begin + l] >= 0) continue;
      for (std::size_t t = 0; t < block.triangles; ++t) {
        const std::size_t from = block.begin + kStride * t, to = from + l;
        for (const Column c : {x, y, angle, reach, corner0, corner1, corner2, corner3, corner4, corner5, inertia})
          column_[c][to] = column_[c][from];
        body_id[to] = -1;
      }
      for (std::size_t b = 0; b < block.beams; ++b) {
        const std::size_t from = block.beam_begin + kStride * b;
        for (const BeamColumn c : {length, xi, yi, xj, yj}) beam_column_[c][from + l] = beam_column_[c][from];
      }
    }
}

void GrainStore::place(std::size_t k, const Vec2& r) {
  const Vec2 shift = r - centre_[k];
  centre_[k] = r;
  if (shift == Vec2{}) return;
  for (std::size_t t = 0; t < triangles(k); ++t) {
    const std::size_t s = slot(k, t);
    column_[x][s] += shift[0], column_[y][s] += shift[1];
    column_[built_x][s] += shift[0], column_[built_y][s] += shift[1];
    double* row = rows.data() + s * kernel::kCornerRow;
    for (int c = 0; c < 3; ++c) row[2 * c] += shift[0], row[2 * c + 1] += shift[1];
  }
}

void GrainStore::reorder(const std::vector<std::int32_t>& to) {
  const auto permute = [&](auto& values) {
    auto old = values;
    for (std::size_t k = 0; k < to.size(); ++k) values[idx(to[k])] = old[k];
  };
  const std::vector<std::size_t> old_slot = slot_, old_beam = beam_slot_;
  permute(id), permute(part_), permute(radius_), permute(inverse_length_), permute(centre_), permute(tight_),
      permute(topology_);
  std::vector<std::size_t> from(grains());
  std::iota(from.begin(), from.end(), std::size_t{0});
  for (std::size_t k = 0; k < to.size(); ++k) from[idx(to[k])] = k;
  auto old_column = std::move(column_);
  auto old_beam_column = std::move(beam_column_);
  const AlignedVector<double> old_rows = std::move(rows), old_loads = std::move(loads);
  const std::vector<std::int64_t> old_body = std::move(body_id);
  lay_out();
  for (std::size_t g = 0; g < grains(); ++g) {
    for (std::size_t t = 0; t < triangles(g); ++t) {
      const std::size_t s = slot(g, t), was = old_slot[from[g]] + kStride * t;
      for (std::size_t c = 0; c < columns; ++c) column_[c][s] = old_column[c][was];
      std::copy_n(old_rows.begin() + static_cast<std::ptrdiff_t>(was * kernel::kCornerRow), kernel::kCornerRow,
                  rows.begin() + static_cast<std::ptrdiff_t>(s * kernel::kCornerRow));
      std::copy_n(old_loads.begin() + static_cast<std::ptrdiff_t>(was * kernel::kLoadRow), kernel::kLoadRow,
                  loads.begin() + static_cast<std::ptrdiff_t>(s * kernel::kLoadRow));
      body_id[s] = old_body[was];
    }
    for (std::size_t b = 0; b < beams(g); ++b)
      for (std::size_t c = 0; c < beam_columns; ++c)
        beam_column_[c][beam_place(g, b)] = old_beam_column[c][old_beam[from[g]] + kStride * b];
  }
  fill_padding();
}

void GrainStore::measure_circles() {
  centre_.resize(grains()), tight_.resize(grains());
  for (std::size_t g = 0; g < grains(); ++g) {
    Vec2 sum{};
    for (std::size_t t = 0; t < triangles(g); ++t) sum += Vec2{{column_[x][slot(g, t)], column_[y][slot(g, t)]}};
    centre_[g] = (1 / static_cast<double>(triangles(g))) * sum;
    double squared = 0;
    for (std::size_t t = 0; t < triangles(g); ++t) {
      const double* row = rows.data() + slot(g, t) * kernel::kCornerRow;
      for (int c = 0; c < 3; ++c) {
        const Vec2 d = Vec2{{row[2 * c], row[2 * c + 1]}} - centre_[g];
        squared = std::max(squared, dot(d, d));
      }
    }
    tight_[g] = std::sqrt(squared);
  }
}

bool GrainStore::grow_circles() {
  bool held = true;
  for (std::size_t g = 0; g < grains(); ++g)
    if (!(tight_[g] <= radius_[g])) radius_[g] = kGrowth * tight_[g], held = false;
  return held;
}

double GrainStore::largest_radius() const {
  return listed_ == 0 ? 0.0
                      : *std::max_element(radius_.begin(), radius_.begin() + static_cast<std::ptrdiff_t>(listed_));
}

GrainArrays GrainStore::arrays() {
  auto& c = column_;
  auto& b = beam_column_;
  GrainArrays a{};
  a.x = c[x].data(), a.y = c[y].data(), a.angle = c[angle].data(), a.cosine = c[cosine].data(), a.sine = c[sine].data();
  a.ux = c[ux].data(), a.uy = c[uy].data(), a.uw = c[uw].data();
  a.px = c[px].data(), a.py = c[py].data(), a.pw = c[pw].data();
  a.fx = c[fx].data(), a.fy = c[fy].data(), a.torque = c[torque].data();
  a.mass = c[mass].data(), a.inverse_mass = c[inverse_mass].data(), a.inverse_inertia = c[inverse_inertia].data();
  a.reach = c[reach].data(), a.heavy = c[heavy].data();
  for (std::size_t k = 0; k < 6; ++k) a.corner[k] = c[corner0 + k].data();
  a.rows = rows.data(), a.loads = loads.data();
  a.length = b[length].data(), a.xi = b[xi].data(), a.yi = b[yi].data(), a.xj = b[xj].data(), a.yj = b[yj].data();
  a.stretching = b[stretching].data(), a.bending = b[bending].data(), a.damping = b[damping].data();
  a.bending_damping = b[bending_damping].data();
  return a;
}

}  // namespace isostat
