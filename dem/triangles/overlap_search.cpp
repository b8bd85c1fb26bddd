#include "dem/triangles/overlap_search.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "dem/triangles/at_rest.hpp"
#include "dem/triangles/paper_contact.hpp"
#include "geometry/base/index.hpp"
#include "geometry/cell_grid.hpp"
#include "geometry/overlap_clip.hpp"

namespace isostat {
namespace {

using kernel::OverlapLanes;
using kernel::Scalar;
using kernel::TriangleLanes;

struct Circle {
  Vec2 centre;
  double radius;
};
double cross(const Vec2& u, const Vec2& v) { return u[0] * v[1] - u[1] * v[0]; }

TriangleLanes<Scalar> lanes_of(const std::array<Vec2, 3>& t, const Vec2& offset) {
  TriangleLanes<Scalar> lanes;
  for (std::size_t k = 0; k < 3; ++k) lanes.x[k] = t[k][0] + offset[0], lanes.y[k] = t[k][1] + offset[1];
  return lanes;
}

// Circles about the boxes of the grains as they stand.
std::vector<Circle> circles_of(const TrianglePacking& p, const std::vector<std::array<Vec2, 3>>& corners) {
  std::vector<Circle> circles(p.grains.size());
  for (std::size_t g = 0; g < circles.size(); ++g) {
    Vec2 low{{INFINITY, INFINITY}}, high{{-INFINITY, -INFINITY}};
    for (auto k = idx(p.grains.begin[g]); k < idx(p.grains.begin[g + 1]); ++k)
      for (const Vec2& c : corners[k])
        for (int a = 0; a < 2; ++a) low[a] = std::min(low[a], c[a]), high[a] = std::max(high[a], c[a]);
    circles[g] = {0.5 * (low + high), 0};
    for (auto k = idx(p.grains.begin[g]); k < idx(p.grains.begin[g + 1]); ++k)
      for (const Vec2& c : corners[k]) circles[g].radius = std::max(circles[g].radius, norm(c - circles[g].centre));
  }
  return circles;
}

// Pairs of one pair of grains.
class PairsOfGrains {
 public:
  PairsOfGrains(const TrianglePacking& p, const std::vector<std::array<Vec2, 3>>& corners,
                std::vector<TrianglePair>& found)
      : p_(p), corners_(corners), found_(found) {}

  void look(std::size_t g, std::size_t h, const ImageShift<2>& shift) {
    if (p_.grains.part[g] != GrainPart::free && p_.grains.part[h] != GrainPart::free) return;
    const Vec2 offset = p_.cell ? p_.cell->offset(shift) : Vec2{};
    for (std::int32_t a = p_.grains.begin[g]; a < p_.grains.begin[g + 1]; ++a)
      for (std::int32_t b = p_.grains.begin[h]; b < p_.grains.begin[h + 1]; ++b) {
        const Vec2 d = p_.bodies.position[idx(b)] + offset - p_.bodies.position[idx(a)];
        const double reach = p_.bodies.radius[idx(a)] + p_.bodies.radius[idx(b)];
        if (dot(d, d) > reach * reach) continue;
        const auto& near = corners_[idx(a)];
        const OverlapLanes<Scalar> o = kernel::overlap_lanes(lanes_of(near, {}), lanes_of(corners_[idx(b)], offset));
        if (!(o.area[0] > 0)) continue;
        found_.push_back({static_cast<std::int32_t>(g), static_cast<std::int32_t>(h), shift, a, b, o.area[0],
                          Vec2{{o.gradient_x[0], o.gradient_y[0]}}, o.rotation_a[0], o.rotation_b[0],
                          near[0] + Vec2{{o.point_x[0], o.point_y[0]}}});
      }
  }

 private:
  const TrianglePacking& p_;
  const std::vector<std::array<Vec2, 3>>& corners_;
  std::vector<TrianglePair>& found_;
};

auto key(const TrianglePair& p) { return std::tie(p.grain_i, p.grain_j, p.shift, p.a, p.b); }
bool same_grains(const TrianglePair& p, const TrianglePair& q) {
  return p.grain_i == q.grain_i && p.grain_j == q.grain_j && p.shift == q.shift;
}

// What all pairs of triangles of two grains have in common.
struct Whole {
  double area = 0, chord = 0;
  Vec2 gradient{}, point{}, normal{};
};
Whole whole_of(const TrianglePair* begin, const TrianglePair* end) {
  Whole w;
  for (const TrianglePair* p = begin; p != end; ++p)
    w.area += p->area, w.gradient += p->gradient, w.point += p->area * p->point;
  w.point = (1 / w.area) * w.point;
  w.chord = norm(w.gradient);
  if (w.chord > 0) w.normal = (1 / w.chord) * w.gradient;
  return w;
}

template <class Visit>
void by_grains(const std::vector<TrianglePair>& pairs, Visit&& visit) {
  for (std::size_t k = 0, end; k < pairs.size(); k = end) {
    for (end = k + 1; end < pairs.size() && same_grains(pairs[k], pairs[end]);) ++end;
    visit(pairs.data() + k, pairs.data() + end);
  }
}

Triangle triangle_at(const TrianglePacking& p, std::int32_t k, const Vec2& offset) {
  Triangle t{corners_of(p, idx(k))};
  for (Vec2& c : t.corner) c += offset;
  return t;
}
PaperContact paper_force(const TrianglePacking& p, const TriangleLaw& law, const TrianglePair& pair) {
  const Vec2 offset = p.cell ? p.cell->offset(pair.shift) : Vec2{};
  return paper_contact(triangle_at(p, pair.a, {}), triangle_at(p, pair.b, offset), law.modulus);
}

}  // namespace

std::vector<TrianglePair> overlapping_triangles(const TrianglePacking& p) {
  std::vector<TrianglePair> found;
  std::vector<std::array<Vec2, 3>> corners(p.bodies.size());
  for (std::size_t k = 0; k < corners.size(); ++k) corners[k] = corners_of(p, k);
  const std::vector<Circle> circles = circles_of(p, corners);
  // Which image of the cell a centre lies in: the grid wants centres inside.
  const auto image_of = [&p](const Vec2& r, int a) {
    return p.cell ? static_cast<int>(std::floor(r[a] / p.cell->length[a])) : 0;
  };
  const auto wrapped = [&](const Vec2& r) { return p.cell ? r - p.cell->offset({image_of(r, 0), image_of(r, 1)}) : r; };
  PairsOfGrains pairs(p, corners, found);
  // Walls may be far larger than grains: those go against all, the others by a grid.
  double largest = 0;
  for (std::size_t g = 0; g < circles.size(); ++g)
    if (p.grains.part[g] == GrainPart::free) largest = std::max(largest, circles[g].radius);
  std::vector<std::size_t> small, large;
  std::vector<Vec2> centres;
  for (std::size_t g = 0; g < circles.size(); ++g)
    if (p.grains.part[g] != GrainPart::free && circles[g].radius > 2 * largest)
      large.push_back(g);
    else
      small.push_back(g), centres.push_back(wrapped(circles[g].centre)), largest = std::max(largest, circles[g].radius);
  for (const std::size_t w : large)
    for (const std::size_t g : small)
      if (norm(circles[g].centre - circles[w].centre) < circles[g].radius + circles[w].radius)
        pairs.look(std::min(g, w), std::max(g, w), {});
  if (!small.empty()) {
    const Frame<2> frame = frame_of(p.cell, centres);
    const CellGrid<2> grid(frame, std::max(2 * largest, 1e-300), small.size());
    const GridMembers<2> members(grid, centres);
    for (std::size_t m = 0; m < small.size(); ++m) {
      const std::size_t g = small[m];
      const std::array<int, 2> at = grid.columns(centres[m]);
      for (int oy = -1; oy <= 1; ++oy)
        for (int ox = -1; ox <= 1; ++ox) {
          std::array<int, 2> c{at[0] + ox, at[1] + oy};
          ImageShift<2> image{};
          bool outside = false;
          for (std::size_t a = 0; a < 2; ++a) {
            const int n = grid.count(static_cast<int>(a));
            if (c[a] >= 0 && c[a] < n) continue;
            outside = outside || !p.cell;
            image[a] = c[a] < 0 ? -1 : 1;
            c[a] = c[a] < 0 ? c[a] + n : c[a] - n;
          }
          if (outside) continue;
          const std::size_t box = grid.index(c);
          for (auto k = idx(members.begin[box]); k < idx(members.begin[box + 1]); ++k) {
            const std::size_t h = small[idx(members.member[k])];
            if (h <= g) continue;
            ImageShift<2> shift = image;
            for (int a = 0; a < 2; ++a)
              shift[static_cast<std::size_t>(a)] += image_of(circles[g].centre, a) - image_of(circles[h].centre, a);
            const Vec2 offset = p.cell ? p.cell->offset(shift) : Vec2{};
            if (norm(circles[h].centre + offset - circles[g].centre) < circles[g].radius + circles[h].radius)
              pairs.look(g, h, shift);
          }
        }
    }
  }
  std::sort(found.begin(), found.end(), [](const TrianglePair& x, const TrianglePair& y) { return key(x) < key(y); });
  found.erase(std::unique(found.begin(), found.end(),
                          [](const TrianglePair& x, const TrianglePair& y) { return key(x) == key(y); }),
              found.end());
  return found;
}

namespace {

using GrainKey = std::tuple<std::int32_t, std::int32_t, ImageShift<2>>;
std::map<GrainKey, double> springs_of(const TrianglePacking& p) {
  std::map<GrainKey, double> springs;
  for (const Overlap& o : p.overlaps)
    if (o.tangential_force != 0) springs[{o.grain_i, o.grain_j, o.shift}] = o.tangential_force;
  return springs;
}
double spring_of(const std::map<GrainKey, double>& springs, const TrianglePair& pair) {
  const auto at = springs.find({pair.grain_i, pair.grain_j, pair.shift});
  return at == springs.end() ? 0.0 : at->second;
}

}  // namespace

std::vector<Overlap> overlaps_of(const TrianglePacking& p, const TriangleLaw& law,
                                 const std::vector<TrianglePair>& pairs) {
  const std::vector<double> inverse = inverse_lengths(p, law);
  const auto springs = springs_of(p);
  std::vector<Overlap> overlaps;
  by_grains(pairs, [&](const TrianglePair* begin, const TrianglePair* end) {
    const Whole w = whole_of(begin, end);
    Overlap o;
    o.grain_i = begin->grain_i, o.grain_j = begin->grain_j, o.shift = begin->shift;
    o.area = w.area, o.point = w.point, o.normal = w.normal;
    o.normal_force = overlap_stiffness(law, inverse[idx(o.grain_i)], inverse[idx(o.grain_j)]) * w.area * w.chord;
    if (law.contact == ContactLaw::paper) {
      Vec2 force{};
      for (const TrianglePair* q = begin; q != end; ++q) force -= paper_force(p, law, *q).on_a;
      o.normal_force = norm(force);
      if (o.normal_force > 0) o.normal = (1 / o.normal_force) * force;
    }
    o.tangential_force = spring_of(springs, *begin);
    overlaps.push_back(o);
  });
  return overlaps;
}

void add_overlap_loads(const TrianglePacking& p, const TriangleLaw& law, const std::vector<TrianglePair>& pairs,
                       std::vector<BodyLoad>& loads, StressTensor& virial) {
  const std::vector<double> inverse = inverse_lengths(p, law);
  const auto springs = springs_of(p);
  by_grains(pairs, [&](const TrianglePair* begin, const TrianglePair* end) {
    const Whole w = whole_of(begin, end);
    const double pressure = overlap_stiffness(law, inverse[idx(begin->grain_i)], inverse[idx(begin->grain_j)]) * w.area;
    const double spring = spring_of(springs, *begin);
    const Vec2 tangent{{-w.normal[1], w.normal[0]}}, offset = p.cell ? p.cell->offset(begin->shift) : Vec2{};
    for (const TrianglePair* q = begin; q != end; ++q) {
      Vec2 on_b = pressure * q->gradient;
      double moment_a = -pressure * q->rotation_a, moment_b = -pressure * q->rotation_b;
      if (law.contact == ContactLaw::paper) {
        const PaperContact c = paper_force(p, law, *q);
        on_b = -1.0 * c.on_a, moment_a = c.moment_a, moment_b = c.moment_b;
      }
      const Vec2 ga = p.bodies.position[idx(q->a)], gb = p.bodies.position[idx(q->b)] + offset;
      if (spring != 0) {
        const Vec2 drag = (spring * q->area / w.area) * tangent;
        on_b += drag;
        moment_a -= cross(w.point - ga, drag), moment_b += cross(w.point - gb, drag);
      }
      BodyLoad &la = loads[idx(q->a)], &lb = loads[idx(q->b)];
      la.fx -= on_b[0], la.fy -= on_b[1], la.moment += moment_a, ++la.links;
      lb.fx += on_b[0], lb.fy += on_b[1], lb.moment += moment_b, ++lb.links;
      const Vec2 r = gb - ga;
      virial.xx += on_b[0] * r[0], virial.xy += on_b[0] * r[1];
      virial.yx += on_b[1] * r[0], virial.yy += on_b[1] * r[1];
    }
  });
}

}  // namespace isostat
