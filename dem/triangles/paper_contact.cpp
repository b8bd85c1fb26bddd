#include "dem/triangles/paper_contact.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "geometry/base/index.hpp"
#include "geometry/triangle_mesh.hpp"
#include "geometry/triangle_overlap.hpp"

namespace isostat {
namespace {

double cross(const Vec2& u, const Vec2& v) { return u[0] * v[1] - u[1] * v[0]; }
double area_of(const Triangle& t) { return 0.5 * doubled_area(t.corner[0], t.corner[1], t.corner[2]); }
Vec2 centroid_of(const Triangle& t) { return (1.0 / 3) * (t.corner[0] + t.corner[1] + t.corner[2]); }
Vec2 edge_of(const Triangle& t, int e) { return t.corner[idx(TriangleSigns::next(e))] - t.corner[idx(e)]; }
// Unit normal of an edge, out of its triangle.
Vec2 outward(const Vec2& edge) {
  const double length = norm(edge);
  return {{edge[1] / length, -edge[0] / length}};
}

// Sums forces on A, each at a point.
class Sum {
 public:
  Sum(const Triangle& a, const Triangle& b) : a_(centroid_of(a)), b_(centroid_of(b)) {}
  void add(const Vec2& on_a, const Vec2& at) {
    sum_.on_a += on_a;
    sum_.moment_a += cross(at - a_, on_a), sum_.moment_b -= cross(at - b_, on_a);
  }
  const PaperContact& get() const { return sum_; }

 private:
  Vec2 a_, b_;
  PaperContact sum_;
};

// The point of edge e of A on the line of edge f of B; on the edge, wherever rounding puts the crossing of two that are
// nearly parallel.
Vec2 crossing(const Triangle& a, int e, const Triangle& b, int f) {
  const Vec2 u = edge_of(a, e), w = edge_of(b, f), d = b.corner[idx(f)] - a.corner[idx(e)];
  const double t = cross(d, w) / cross(u, w);
  return a.corner[idx(e)] + (t >= 0 ? std::min(t, 1.0) : 0.0) * u;
}

// The corner of two edges of a triangle.
int common_corner(int e, int f) { return TriangleSigns::next(e) == f ? f : e; }

// Area of S1, S2 and a corner of a triangle, or what it leaves of the triangle, if that is less.
double cut_area(const Triangle& t, int corner, const Vec2& s1, const Vec2& s2) {
  const double cut = 0.5 * std::abs(doubled_area(s1, s2, t.corner[idx(corner)]));
  return std::min(cut, area_of(t) - cut);
}

// A force of type i for every edge of B that crosses two edges of A: A is pushed out of B.
template <class Crosses>
void push_out(const Triangle& a, const Triangle& b, const Crosses& crosses, double modulus, double sign, Sum& sum) {
  for (int f = 0; f < 3; ++f) {
    int edges[3], count = 0;
    for (int e = 0; e < 3; ++e)
      if (crosses(e, f)) edges[count++] = e;
    if (count != 2) continue;
    const Vec2 s1 = crossing(a, edges[0], b, f), s2 = crossing(a, edges[1], b, f);
    const double force = modulus * cut_area(a, common_corner(edges[0], edges[1]), s1, s2);
    sum.add((sign * force) * outward(edge_of(b, f)), 0.5 * (s1 + s2));
  }
}

// The two edges of A, and of B, that cross; none if they are not as in types i and ii.
struct CrossedEdges {
  std::array<int, 2> a, b;
};
std::optional<CrossedEdges> crossed_edges(const TriangleSigns& signs) {
  CrossedEdges found{};
  int count = 0;
  for (int e = 0; e < 3; ++e)
    for (int f = 0; f < 3; ++f)
      if (signs.cross(e, f)) {
        if (count == 2) return std::nullopt;
        found.a[idx(count)] = e, found.b[idx(count)] = f, ++count;
      }
  return count == 2 ? std::optional(found) : std::nullopt;
}

// The two edges of a triangle that cross edges of the other (type iii); first the one that faces more along `towards`.
struct EdgePair {
  int first = -1, second = -1;
};
template <class Crosses>
EdgePair crossed_twice(const Crosses& crosses, const Triangle& t, const Vec2& towards) {
  EdgePair found;
  for (int e = 0; e < 3; ++e)
    if (crosses(e, 0) || crosses(e, 1) || crosses(e, 2)) (found.first < 0 ? found.first : found.second) = e;
  if (dot(outward(edge_of(t, found.second)) - outward(edge_of(t, found.first)), towards) > 0)
    std::swap(found.first, found.second);
  return found;
}

// Farthest that a point of either is from the centroid of the first.
double reach(const Triangle& of, const Triangle& other) {
  double farthest = 0;
  for (const Triangle* t : {&of, &other})
    for (const Vec2& c : t->corner) farthest = std::max(farthest, norm(c - centroid_of(of)));
  return farthest;
}

// One of the triangles is inside the other: the gradient is 0 but for rounding.
constexpr double kRounding = 1e-8;  // [perimeter of the overlap]
bool of_one_triangle(const TriangleOverlap& o) {
  double perimeter = 0;
  bool all = true;
  for (const OverlapSide& s : o.sides()) perimeter += norm(s.along), all = all && s.owner == o.sides()[0].owner;
  return all || !(norm(o.gradient_a.translation) > kRounding * perimeter);
}

}  // namespace

PaperContact paper_contact(const Triangle& a, const Triangle& b, double modulus) {
  const TriangleSigns signs = triangle_signs(a, b);
  Sum sum(a, b);
  const auto a_on_b = [&](int e, int f) { return signs.cross(e, f); };
  const auto b_on_a = [&](int f, int e) { return signs.cross(e, f); };
  switch (signs.type) {
    case OverlapType::separate:
    case OverlapType::touch:
      break;
    case OverlapType::i:
      // Both crossings on one edge of B, which cuts A, or the other way round.
      push_out(a, b, a_on_b, modulus, 1, sum);
      push_out(b, a, b_on_a, modulus, -1, sum);
      break;
    case OverlapType::ii: {
      const auto edges = crossed_edges(signs).value();
      const Vec2 s1 = crossing(a, edges.a[0], b, edges.b[0]), s2 = crossing(a, edges.a[1], b, edges.b[1]);
      const int corner_a = common_corner(edges.a[0], edges.a[1]), corner_b = common_corner(edges.b[0], edges.b[1]);
      const double force = modulus * (cut_area(a, corner_a, s1, s2) + cut_area(b, corner_b, s1, s2));
      const Vec2 chord = s2 - s1;
      const double length = norm(chord);
      Vec2 normal = outward(chord);
      // The chord parts the boundary of A inside B from that of B inside A: A is pushed away from its own. That is on
      // the side of the corner between the two edges, if this corner is the one inside, else on the other.
      const auto side = [&](const Vec2& corner, const std::array<std::int8_t, 3>& of_other) {
        const bool inside = of_other[0] > 0 && of_other[1] > 0 && of_other[2] > 0;
        return (inside ? 1 : -1) * dot(normal, corner - s1);
      };
      if (side(a.corner[idx(corner_a)], signs.of_a[idx(corner_a)]) >
          side(b.corner[idx(corner_b)], signs.of_b[idx(corner_b)]))
        normal = -1.0 * normal;
      if (length > 0) sum.add(force * normal, 0.5 * (s1 + s2));
      break;
    }
    case OverlapType::iii: {
      // S1 is where those edges cross that push the triangles apart most: whichever of them is called A, and wherever
      // its corners begin.
      const Vec2 apart = centroid_of(a) - centroid_of(b);
      const EdgePair of_a = crossed_twice([&](int e, int f) { return signs.cross(e, f); }, a, -1.0 * apart);
      const EdgePair of_b = crossed_twice([&](int f, int e) { return signs.cross(e, f); }, b, apart);
      const Vec2 s1 = crossing(a, of_a.first, b, of_b.first), s2 = crossing(a, of_a.first, b, of_b.second),
                 s4 = crossing(a, of_a.second, b, of_b.first);
      const double force = 0.5 * modulus * triangle_overlap(a, b).area;
      sum.add(-force * outward(edge_of(a, of_a.first)), 0.5 * (s1 + s2));
      sum.add(force * outward(edge_of(b, of_b.first)), 0.5 * (s1 + s4));
      break;
    }
    case OverlapType::iv:
    case OverlapType::v:
      push_out(a, b, a_on_b, modulus, 1, sum);
      push_out(b, a, b_on_a, modulus, -1, sum);
      break;
    case OverlapType::degenerate: {
      // Where edges coincide a gradient is one-sided, that of the first triangle: the mean is nobody's.
      const TriangleOverlap o = triangle_overlap(a, b), turned = triangle_overlap(b, a);
      if (of_one_triangle(o) || of_one_triangle(turned)) break;
      const Vec2 g = 0.5 * (o.gradient_a.translation - turned.gradient_a.translation);
      const double turn_a = 0.5 * (o.gradient_a.rotation + turned.gradient_b.rotation);
      const double turn_b = 0.5 * (o.gradient_b.rotation + turned.gradient_a.rotation);
      // The arms of a force reach no further than the triangles: nearly on each other they'd meet a couple without one.
      const double chord = std::max({norm(g), std::abs(turn_a) / reach(a, b), std::abs(turn_b) / reach(b, a)});
      if (!(chord > 0)) break;
      const double pressure = modulus * o.area / chord;
      return {-pressure * g, -pressure * turn_a, -pressure * turn_b};
    }
  }
  return sum.get();
}

}  // namespace isostat
