#include "dem/triangles/overlap_search.hpp"

#include <cmath>
#include <map>
#include <tuple>

#include "dem/triangles/at_rest.hpp"
#include "dem/triangles/paper_contact.hpp"
#include "dem/triangles/touching_triangles.hpp"
#include "geometry/base/index.hpp"
#include "geometry/overlap_clip.hpp"

namespace isostat {
namespace {

using kernel::OverlapLanes;
using kernel::Scalar;
using kernel::TriangleLanes;

double cross(const Vec2& u, const Vec2& v) { return u[0] * v[1] - u[1] * v[0]; }

TriangleLanes<Scalar> lanes_of(const Triangle& t) {
  TriangleLanes<Scalar> lanes;
  for (std::size_t k = 0; k < 3; ++k) lanes.x[k] = t.corner[k][0], lanes.y[k] = t.corner[k][1];
  return lanes;
}

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
  const std::vector<Triangle> triangles = placed_triangles(p);
  const std::vector<std::int32_t> grain = grain_of(p.grains);
  std::vector<TrianglePair> found;
  for (const TriangleTouch& touch : touching_triangles(p, triangles)) {
    const std::int32_t gi = grain[idx(touch.i)], gj = grain[idx(touch.j)];
    if (gi == gj) continue;  // its own image: the lists refuse a cell so small
    const Triangle &near = triangles[idx(touch.i)], far = image_of(triangles[idx(touch.j)], p.cell, touch.shift);
    const OverlapLanes<Scalar> o = kernel::overlap_lanes(lanes_of(near), lanes_of(far));
    if (!(o.area[0] > 0)) continue;
    found.push_back({gi, gj, touch.shift, touch.i, touch.j, o.area[0], Vec2{{o.gradient_x[0], o.gradient_y[0]}},
                     o.rotation_a[0], o.rotation_b[0], near.corner[0] + Vec2{{o.point_x[0], o.point_y[0]}}});
  }
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
