#include "geometry/pores.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "geometry/arc_moments.hpp"
#include "geometry/base/index.hpp"
#include "geometry/disk_complex.hpp"
#include "geometry/placed_sets.hpp"

namespace isostat {
namespace {

constexpr double kTwoPi = 2 * std::numbers::pi;

// One arc on its way to its pore.
struct Wall {
  std::int32_t pore;
  std::int32_t disk;
  ImageShift<2> image;  // of the disk, in the pore's frame
  Vec2 start;           // unit vector
  double sweep;
  std::int32_t start_slot, end_slot;  // closed edges between which the arc lies; -1: a whole circle
};

class PoreFinder {
 public:
  PoreFinder(const DiskComplex& complex) : c_(complex), t_(complex.triangulation), faces_(t_.faces.size()) {}

  Pores find(bool with_arcs) {
    join_open_faces();
    name_pores();
    for (std::int32_t i = 0; idx(i) < c_.size(); ++i) walls_of(i);
    measure();
    return finish(with_arcs);
  }

 private:
  using Faces = PlacedSets<2>;
  struct Loop {  // of open faces, and how it winds around the cell
    std::int32_t face;
    ImageShift<2> winding;
  };

  bool open(std::int32_t face) const { return !c_.face_covered[idx(face)]; }

  void join_open_faces() {
    for (std::int32_t i = 0; idx(i) + 1 < t_.first.size(); ++i)
      for (auto slot = t_.first[idx(i)]; slot < t_.first[idx(i) + 1]; ++slot) {
        const auto left = idx(slot), right = idx(t_.previous(i, slot));
        // From a disk's side both slots of an edge are seen: once is enough. Auxiliary sites close nothing.
        if (c_.edge[left] != EdgeState::open || t_.neighbour[left].site < i) continue;
        const auto relative = Faces::difference(t_.face_shift[right], t_.face_shift[left]);
        if (const auto winding = faces_.join(t_.face[left], t_.face[right], relative);
            winding && *winding != ImageShift<2>{})
          loops_.push_back({t_.face[left], *winding});
      }
  }

  void name_pores() {
    pore_of_face_.assign(t_.faces.size(), -1);
    std::vector<std::int32_t> name(t_.faces.size(), -1);
    for (std::int32_t f = 0; idx(f) < t_.faces.size(); ++f) {
      if (!open(f)) continue;
      const auto root = faces_.find(f).root;
      if (name[idx(root)] < 0) {
        name[idx(root)] = static_cast<std::int32_t>(pores_.size());
        pores_.emplace_back();
      }
      pore_of_face_[idx(f)] = name[idx(root)];
    }
    for (const Loop& loop : loops_) {
      Pore& p = pores_[idx(pore_of_face_[idx(loop.face)])];
      for (std::size_t k = 0; k < 2; ++k) p.along[k] |= loop.winding[k] != 0;
      p.percolating = p.along[0] || p.along[1];
    }
    local_area_.assign(pores_.size(), 0);
    for (std::int32_t f = 0; idx(f) < t_.faces.size(); ++f) {
      double& area = open(f) ? local_area_[idx(pore_of_face_[idx(f)])] : covered_;
      area += face_area(f);
    }
  }

  double face_area(std::int32_t f) const {
    const auto& v = t_.faces[idx(f)];
    const auto slot = t_.slot_of(v[0].site, v[1]);
    const Vec2 &a = c_.branch[idx(slot)], &b = c_.branch[idx(t_.next(v[0].site, slot))];
    return 0.5 * (a[0] * b[1] - a[1] * b[0]);
  }

  // Half angle under which disk i sees the lens it shares with the neighbour of a closed slot.
  struct HalfAngle {
    double cosine, sine, angle;
  };
  HalfAngle half_angle(std::int32_t i, std::int32_t slot) const {
    if (c_.edge[idx(slot)] == EdgeState::bridged) return {1, 0, 0};
    const double r = c_.radius[idx(i)], q = c_.radius[idx(t_.neighbour[idx(slot)].site)];
    const double d = norm(c_.branch[idx(slot)]);
    // Heron's form: no cancellation but in r + q - d itself.
    const double product = (r + q - d) * (r + q + d) * (d - (r - q)) * (d + (r - q));
    const double cosine = (d * d + (r - q) * (r + q)) / (2 * d * r);
    const double sine = product > 0 ? std::sqrt(product) / (2 * d * r) : 0;
    return {cosine, sine, std::atan2(sine, cosine)};
  }

  double sector_angle(std::int32_t i, std::int32_t slot) const {
    const Vec2 &a = c_.branch[idx(slot)], &b = c_.branch[idx(t_.next(i, slot))];
    return std::atan2(a[0] * b[1] - a[1] * b[0], dot(a, b));
  }

  // A disk without closed edge is either whole or covered by others: its centre tells, being in its own power cell
  // or not.
  bool covered_by_others(std::int32_t i) const {
    const double w = c_.radius[idx(i)] * c_.radius[idx(i)];
    for (auto slot = t_.first[idx(i)]; slot < t_.first[idx(i) + 1]; ++slot) {
      const auto j = t_.neighbour[idx(slot)].site;
      if (!c_.is_disk(j)) continue;
      const double q = c_.radius[idx(j)];
      if (dot(c_.branch[idx(slot)], c_.branch[idx(slot)]) + w - q * q < 0) return true;
    }
    return t_.first[idx(i)] == t_.first[idx(i) + 1];
  }

  void add_wall(std::int32_t i, std::int32_t open_slot, const Vec2& start, double sweep, std::int32_t start_slot,
                std::int32_t end_slot) {
    const auto f = t_.face[idx(open_slot)];
    const auto pore = pore_of_face_[idx(f)];
    // The listed face lies in image `offset` of the pore's frame; the one seen from disk i in its own image is it
    // moved by face_shift, so disk i has to be moved by the difference.
    walls_.push_back({pore, i, Faces::difference(faces_.find(f).image, t_.face_shift[idx(open_slot)]), start, sweep,
                      start_slot, end_slot});
    const double r = c_.radius[idx(i)];
    local_area_[idx(pore)] -= 0.5 * r * r * sweep;
    covered_ += 0.5 * r * r * sweep;
    perimeter_ += r * sweep;
  }

  // Triangle of the two centres and the crossing point of the circles, on an open side of a closed edge; half of it
  // from either end.
  void add_kite(std::int32_t i, std::int32_t slot, std::int32_t open_slot, const HalfAngle& h) {
    const double area = 0.25 * norm(c_.branch[idx(slot)]) * h.sine * c_.radius[idx(i)];
    local_area_[idx(pore_of_face_[idx(t_.face[idx(open_slot)])])] -= area;
    covered_ += area;
  }

  void walls_of(std::int32_t i) {
    const auto begin = t_.first[idx(i)], end = t_.first[idx(i) + 1];
    std::int32_t anchor = -1;
    for (auto slot = begin; slot < end && anchor < 0; ++slot)
      if (c_.edge[idx(slot)] != EdgeState::open) anchor = slot;
    if (anchor < 0) {
      if (!covered_by_others(i)) add_wall(i, begin, {1, 0}, kTwoPi, -1, -1);
      return;
    }
    auto slot = anchor;
    auto from = half_angle(i, slot);
    do {
      const auto first_sector = slot;
      double angle = 0;
      do {
        angle += sector_angle(i, slot);
        slot = t_.next(i, slot);
      } while (c_.edge[idx(slot)] == EdgeState::open);
      const auto to = half_angle(i, slot);
      if (open(t_.face[idx(first_sector)])) {
        if (slot == first_sector) angle = kTwoPi;
        const Vec2 u = (1 / norm(c_.branch[idx(first_sector)])) * c_.branch[idx(first_sector)];
        const Vec2 start{u[0] * from.cosine - u[1] * from.sine, u[1] * from.cosine + u[0] * from.sine};
        add_wall(i, first_sector, start, angle - from.angle - to.angle, first_sector, slot);
        add_kite(i, first_sector, first_sector, from);
        add_kite(i, slot, t_.previous(i, slot), to);
      }
      from = to;
    } while (slot != anchor);
  }

  Vec2 placed(const Wall& w) const { return c_.centre[idx(w.disk)] + c_.cell.offset(w.image); }

  // From the end of an arc on a bridged edge the wall crosses the gap to the neighbour's surface.
  WallIntegrals bridge_integrals(const Wall& w, const Vec2& centre) const {
    if (w.end_slot < 0 || c_.edge[idx(w.end_slot)] != EdgeState::bridged) return {};
    const Vec2 d = c_.branch[idx(w.end_slot)];
    const Vec2 u = (1 / norm(d)) * d;
    const double q = c_.radius[idx(t_.neighbour[idx(w.end_slot)].site)];
    return link_integrals(centre + c_.radius[idx(w.disk)] * u, centre + (d - q * u));
  }

  void measure() {
    std::vector<WallIntegrals> sum(pores_.size());
    std::vector<Vec2> origin(pores_.size());
    std::vector<bool> seen(pores_.size(), false);
    for (const auto& w : walls_) {
      const auto k = idx(w.pore);
      if (pores_[k].percolating) continue;
      const Vec2 centre = placed(w);
      const double r = c_.radius[idx(w.disk)];
      if (!seen[k]) seen[k] = true, origin[k] = centre + r * w.start;  // on the wall: small pores stay exact
      sum[k] += arc_integrals(centre - origin[k], r, w.start, w.sweep);
      sum[k] += bridge_integrals(w, centre - origin[k]);
    }
    for (std::size_t k = 0; k < pores_.size(); ++k) {
      auto& p = pores_[k];
      if (p.percolating) {
        p.area = local_area_[k];
        continue;
      }
      // The pore is on the right of its walls: signs turned.
      p.area = std::max(0.0, -sum[k].w / 2);
      p.equivalent_radius = std::numeric_limits<double>::quiet_NaN();
      p.centroid = origin[k];
      if (!(p.area > 0)) continue;
      const Vec2 c{-sum[k].xw / 3 / p.area, -sum[k].yw / 3 / p.area};
      const double gyration = -sum[k].rrw / 4 - p.area * dot(c, c);
      if (!(gyration > 0)) continue;  // smaller than the rounding of its walls
      p.centroid += c;
      p.gyration = gyration;
      p.equivalent_radius = std::sqrt(2 * gyration / p.area);
    }
  }

  Pores finish(bool with_arcs) {
    Pores out;
    out.cell = c_.cell;
    out.covered_area = covered_;
    out.perimeter = perimeter_;
    std::vector<std::size_t> order(pores_.size()), rank(pores_.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      const auto &p = pores_[a], &q = pores_[b];
      if (p.percolating != q.percolating) return p.percolating;
      return p.area != q.area ? p.area > q.area : a < b;
    });
    for (std::size_t k = 0; k < order.size(); ++k) rank[order[k]] = k, out.pores.push_back(pores_[order[k]]);
    if (with_arcs) list_arcs(out, rank);
    return out;
  }

  void list_arcs(Pores& out, const std::vector<std::size_t>& rank) const {
    for (const auto& w : walls_) ++out.pores[rank[idx(w.pore)]].arcs;
    std::uint32_t total = 0;
    for (auto& p : out.pores) p.first_arc = total, total += p.arcs;
    std::vector<std::uint32_t> filled(out.pores.size(), 0), place(walls_.size());
    std::vector<std::uint32_t> starting_at(t_.neighbour.size(), 0);  // wall that starts at a slot
    for (std::size_t n = 0; n < walls_.size(); ++n) {
      const auto k = rank[idx(walls_[n].pore)];
      place[n] = out.pores[k].first_arc + filled[k]++;
      if (walls_[n].start_slot >= 0) starting_at[idx(walls_[n].start_slot)] = static_cast<std::uint32_t>(n);
    }
    out.arcs.resize(walls_.size());
    for (std::size_t n = 0; n < walls_.size(); ++n) {
      const auto& w = walls_[n];
      std::uint32_t next = place[n];
      if (w.end_slot >= 0) {  // on the other disk of the edge at which this one ends
        const auto& j = t_.neighbour[idx(w.end_slot)];
        next = place[starting_at[idx(t_.slot_of(j.site, {w.disk, {-j.shift[0], -j.shift[1]}}))]];
      }
      out.arcs[place[n]] = {
          c_.input[idx(w.disk)], placed(w), c_.radius[idx(w.disk)], std::atan2(w.start[1], w.start[0]), w.sweep, next};
    }
  }

  const DiskComplex& c_;
  const PowerTriangulation& t_;
  Faces faces_;
  std::vector<Loop> loops_;
  std::vector<std::int32_t> pore_of_face_;
  std::vector<Pore> pores_;
  std::vector<double> local_area_;  // of each pore: its open faces less the sectors and kites that reach into them
  std::vector<Wall> walls_;
  double covered_ = 0, perimeter_ = 0;
};

}  // namespace

Pores find_pores(std::span<const Vec2> centre, std::span<const double> radius, const PeriodicCell<2>& cell,
                 const PoreOptions& options) {
  const auto complex = disk_complex(centre, radius, cell, options.gap_tolerance);
  if (complex.size() == 0) {
    Pores all;
    all.cell = cell;
    Pore p;
    p.area = cell.measure(), p.percolating = true, p.along = {true, true};
    all.pores.push_back(p);
    return all;
  }
  return PoreFinder(complex).find(options.with_arcs);
}

}  // namespace isostat
