#include "geometry/triangle_overlap.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <string>

#include "geometry/base/index.hpp"
#include "geometry/orientation.hpp"
#include "geometry/polygon_intersection.hpp"
#include "tests/oracle/rational_overlap.hpp"
#include "tests/support/triangle_pairs.hpp"

namespace isostat {
namespace {

using oracle::PairKind;
using oracle::TrianglePair;

constexpr double kUnit = 0x1p-53;
const mpq_class kLeastDouble(0x1p-1074);  // areas may underflow: corners at 0 move by units in the last place, too

double cross(const Vec2& p, const Vec2& q) { return p[0] * q[1] - p[1] * q[0]; }
Triangle moved(Triangle t, const Vec2& to_origin) {
  for (Vec2& c : t.corner) c -= to_origin;
  return t;
}
Vec2 centroid(const Triangle& t) { return (1.0 / 3) * (t.corner[0] + t.corner[1] + t.corner[2]); }

// Largest coordinate relative to corner 0 of A: M of the error bounds.
double extent(const TrianglePair& p) {
  double m = 0;
  for (const Triangle* t : {&p.a, &p.b})
    for (const Vec2& c : t->corner)
      for (int k = 0; k < 2; ++k) m = std::max(m, std::abs(c[k] - p.a.corner[0][k]));
  return m;
}

std::string text(const TrianglePair& p) {
  std::string s;
  char number[40];
  for (const Triangle* t : {&p.a, &p.b})
    for (const Vec2& c : t->corner)
      for (int k = 0; k < 2; ++k) std::snprintf(number, sizeof number, "%a,", c[k]), s += number;
  return s;
}

struct Case {
  std::string name, kind;
  TrianglePair pair;
  double area;
};
std::vector<Case> cases() {
  std::ifstream in(ISOSTAT_DATA "/geometry/overlap_cases.json");
  std::vector<Case> list;
  const auto json = nlohmann::json::parse(in);
  for (const auto& j : json["cases"]) {
    const auto hex = [](const nlohmann::json& v) { return std::strtod(v.get<std::string>().c_str(), nullptr); };
    Case c{j["name"], j["kind"], {}, hex(j["area"])};
    for (std::size_t k = 0; k < 3; ++k) {
      c.pair.a.corner[k] = {hex(j["A"][k][0]), hex(j["A"][k][1])};
      c.pair.b.corner[k] = {hex(j["B"][k][0]), hex(j["B"][k][1])};
    }
    list.push_back(c);
  }
  return list;
}

TEST(TriangleOverlap, matches_the_checked_cases) {
  const auto list = cases();
  ASSERT_EQ(list.size(), 170u);
  for (const Case& c : list) {
    const TriangleOverlap o = triangle_overlap(c.pair.a, c.pair.b);
    EXPECT_EQ(name(o.type), c.kind) << c.name;
    EXPECT_NEAR(o.area, c.area, 2 * kUnit * c.area) << c.name;  // as near as two roundings can be
  }
}

// What holds for every overlap, whatever the pair.
void expect_whole(const TrianglePair& p, const TriangleOverlap& o, const std::string& where) {
  const double m = extent(p);
  const auto sides = o.sides();
  if (o.type == OverlapType::separate || o.type == OverlapType::touch) {
    EXPECT_EQ(o.area, 0) << where;
    EXPECT_EQ(sides.size(), 0u) << where;
    return;
  }
  ASSERT_GE(sides.size(), 3u) << where;
  Vec2 sum;
  double twice_area = 0;
  for (std::size_t k = 0; k < sides.size(); ++k) {
    const OverlapSide& s = sides[k];
    sum += s.along;
    twice_area += cross(s.start - sides[0].start, s.along);
    const Triangle& t = s.owner == Owner::a ? p.a : p.b;
    const Vec2 p0 = t.corner[s.edge] - p.a.corner[0], p1 = t.corner[(s.edge + 1u) % 3] - p.a.corner[0];
    const Vec2 middle = s.start + 0.5 * s.along;
    EXPECT_NEAR(cross(p1 - p0, middle - p0), 0, 16 * kUnit * m * m) << where << " side " << k;
  }
  EXPECT_LE(norm(sum), 8 * kUnit * m) << where;
  EXPECT_NEAR(twice_area / 2, o.area, 16 * kUnit * m * m) << where;
  // Virtual work: a common translation or rotation changes no area.
  EXPECT_EQ(o.gradient_a.translation + o.gradient_b.translation, Vec2()) << where;
  const Vec2& origin = p.a.corner[0];
  const Vec2 ga = centroid(moved(p.a, origin)), gb = centroid(moved(p.b, origin));
  EXPECT_NEAR(o.gradient_a.rotation + cross(ga, o.gradient_a.translation) + o.gradient_b.rotation +
                  cross(gb, o.gradient_b.translation),
              0, 64 * kUnit * m * m)
      << where;
  const bool i_or_ii = o.type == OverlapType::i || o.type == OverlapType::ii;
  EXPECT_EQ(o.chords().size(), i_or_ii ? 1u : o.type == OverlapType::iii ? 2u : 0u) << where;
  if (i_or_ii) {
    EXPECT_NEAR(o.chords()[0].length, norm(o.gradient_a.translation), 16 * kUnit * m) << where;
  }
}

// Type equal, area within 2^-52 of itself, sides between the corners of the rational polygon.
void expect_exact(const TrianglePair& p, std::map<std::string, int>& seen, const std::string& what) {
  const TriangleOverlap o = triangle_overlap(p.a, p.b);
  const oracle::RationalOverlap exact = oracle::rational_overlap(p.a, p.b);
  const std::string where = what + " " + text(p);
  ++seen[std::string(name(o.type))];
  ASSERT_EQ(name(o.type), name(exact.type)) << where;
  ASSERT_EQ(overlap_type(p.b, p.a), o.type) << where;
  const mpq_class error = abs(mpq_class(o.area) - exact.area);
  ASSERT_LE(error, exact.area * mpq_class(0x1p-52) + kLeastDouble) << where << " area " << o.area;
  expect_whole(p, o, where);
  const double m = extent(p);
  for (const OverlapSide& s : o.sides()) {
    double nearest = 1e300;
    for (const auto& v : exact.polygon) {
      const mpq_class x = v.x - mpq_class(p.a.corner[0][0]), y = v.y - mpq_class(p.a.corner[0][1]);
      nearest = std::min(nearest, std::hypot(x.get_d() - s.start[0], y.get_d() - s.start[1]));
    }
    ASSERT_LE(nearest, 4 * kUnit * m) << where;
  }
}

// 1e5 pairs; ISOSTAT_OVERLAP_PAIRS=10000000 for the long form.
TEST(TriangleOverlap, agrees_with_rational_arithmetic_on_random_and_degenerate_pairs) {
  const char* asked = std::getenv("ISOSTAT_OVERLAP_PAIRS");
  const int pairs = asked ? std::atoi(asked) : 100000;
  std::mt19937_64 random(20240917);
  std::map<std::string, int> seen;
  for (int n = 0; n < pairs && !HasFailure(); ++n) {
    const PairKind kind = oracle::kPairKinds[idx(n) % std::size(oracle::kPairKinds)];
    constexpr int nudges[] = {0, 1, 0, 3};
    TrianglePair p = oracle::triangle_pair(kind, nudges[n / 10 % 4], random);
    if (n / 40 % 8 == 1) p = oracle::moved(p, 1e8, -3e7);
    if (n / 40 % 8 == 2) p = oracle::scaled(p, n % 61 - 30);
    expect_exact(p, seen, std::string(oracle::name(kind)) + " " + std::to_string(n));
  }
  for (const char* type : {"separate", "touch", "degenerate", "i", "ii", "iii", "iv", "v"})
    EXPECT_GT(seen[type], pairs / 5000) << type;
}

TEST(TriangleOverlap, is_exact_at_the_ends_of_the_range) {
  std::mt19937_64 random(5);
  std::map<std::string, int> seen;
  for (const int exponent : {-1000, -480, -400, 400, 1000})
    for (int n = 0; n < 200 && !HasFailure(); ++n) {
      const PairKind kind = oracle::kPairKinds[idx(n) % std::size(oracle::kPairKinds)];
      const TrianglePair p = oracle::scaled(oracle::triangle_pair(kind, n % 2, random), exponent);
      const oracle::RationalOverlap exact = oracle::rational_overlap(p.a, p.b);
      ASSERT_EQ(name(overlap_type(p.a, p.b)), name(exact.type)) << text(p);
      if (std::abs(exponent) < 500) {
        const mpq_class error = abs(mpq_class(triangle_overlap(p.a, p.b).area) - exact.area);
        ASSERT_LE(error, exact.area * mpq_class(0x1p-52) + kLeastDouble) << text(p);
      }
    }
}

TEST(TriangleOverlap, of_sets_without_area) {
  const Triangle t{{Vec2{0, 0}, Vec2{2, 0}, Vec2{0, 2}}};
  const auto point = [](double x, double y) { return Triangle{{Vec2{x, y}, Vec2{x, y}, Vec2{x, y}}}; };
  const Triangle segment{{Vec2{3, 3}, Vec2{1, 1}, Vec2{2, 2}}};
  EXPECT_EQ(overlap_type(t, point(0.5, 0.5)), OverlapType::touch);
  EXPECT_EQ(overlap_type(point(1, 1), t), OverlapType::touch);
  EXPECT_EQ(overlap_type(point(1, 1.5), t), OverlapType::separate);
  EXPECT_EQ(overlap_type(t, segment), OverlapType::touch);
  EXPECT_EQ(overlap_type(point(1.5, 1.5), segment), OverlapType::touch);
  EXPECT_EQ(overlap_type(point(1.5, 1), segment), OverlapType::separate);
  EXPECT_EQ(overlap_type(point(4, 4), segment), OverlapType::separate);
  EXPECT_EQ(overlap_type(point(4, 4), point(4, 4)), OverlapType::touch);
  EXPECT_EQ(overlap_type(point(4, 4), point(4, 5)), OverlapType::separate);
  EXPECT_EQ(overlap_type(segment, Triangle{{Vec2{0, 3}, Vec2{3, 0}, Vec2{3, 0}}}), OverlapType::touch);
}

TEST(TriangleOverlap, numbers_sides_and_corners_as_the_caller_does) {
  // Corner 2 of B, which is clockwise, pokes through edge 1 of A.
  const Triangle a{{Vec2{0, 0}, Vec2{4, 0}, Vec2{0, 4}}}, b{{Vec2{3, 4}, Vec2{4, 3}, Vec2{1, 1}}};
  const TriangleOverlap o = triangle_overlap(a, b);
  ASSERT_EQ(o.type, OverlapType::i);
  ASSERT_EQ(o.sides().size(), 3u);
  const OverlapSide &first = o.sides()[0], &second = o.sides()[1], &third = o.sides()[2];
  EXPECT_EQ(first.owner, Owner::a);
  EXPECT_EQ(first.edge, 1);
  EXPECT_EQ(first.start_kind, CornerKind::crossing);
  EXPECT_EQ(first.start_a, 1);
  EXPECT_EQ(first.start_b, 1);  // (4, 3)-(1, 1)
  EXPECT_EQ(second.owner, Owner::b);
  EXPECT_EQ(second.edge, 2);
  EXPECT_EQ(third.start_kind, CornerKind::corner_b);
  EXPECT_EQ(third.start_b, 2);
  EXPECT_EQ(third.edge, 1);
  EXPECT_EQ(third.start, (Vec2{1, 1}));
  EXPECT_DOUBLE_EQ(o.area, 2.0 / 5);  // crossings (2.2, 1.8), (1.8, 2.2)
  EXPECT_DOUBLE_EQ(o.chords()[0].length, 0.4 * std::sqrt(2.0));
  EXPECT_NEAR(o.gradient_b.translation[0], -0.4, 1e-15);  // B away from A: less area
}

TEST(TriangleOverlap, gives_a_side_that_both_have_to_a) {
  const Triangle a{{Vec2{0, 0}, Vec2{2, 0}, Vec2{0, 2}}}, b{{Vec2{0, 0}, Vec2{2, 0}, Vec2{1, 1}}};
  const TriangleOverlap o = triangle_overlap(a, b);
  EXPECT_EQ(o.type, OverlapType::degenerate);
  EXPECT_EQ(o.area, 1);
  ASSERT_EQ(o.sides().size(), 3u);
  int of_a = 0;
  for (const OverlapSide& s : o.sides()) of_a += s.owner == Owner::a;
  EXPECT_EQ(of_a, 2);  // the base, and half of the slope; B's edge from (1, 1) to (0, 0) is inside
}

Triangle displaced(const Triangle& t, const Vec2& by, double angle) {
  const Vec2 g = centroid(t);
  Triangle out;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2 r = t.corner[k] - g;
    out.corner[k] =
        g + by + Vec2{std::cos(angle) * r[0] - std::sin(angle) * r[1], std::sin(angle) * r[0] + std::cos(angle) * r[1]};
  }
  return out;
}

// Areas are quadratic in a translation while the sides stay the same, and nearly so in an angle.
TEST(TriangleOverlap, gradient_is_the_difference_quotient_of_the_area) {
  std::mt19937_64 random(7);
  constexpr double h = 1e-6;
  std::map<OverlapType, int> checked;
  for (int n = 0; n < 6000; ++n) {
    const TrianglePair p = oracle::triangle_pair(n % 3 ? PairKind::random : PairKind::shallow, 0, random);
    const TriangleOverlap o = triangle_overlap(p.a, p.b);
    if (o.type < OverlapType::degenerate) continue;
    const auto slope = [&](const Vec2& by, double angle, bool of_a, bool& same) {
      const auto at = [&](double s) {
        const Triangle a = of_a ? displaced(p.a, s * by, s * angle) : p.a;
        const Triangle b = of_a ? p.b : displaced(p.b, s * by, s * angle);
        const TriangleOverlap q = triangle_overlap(a, b);
        same = same && q.type == o.type && q.side_count == o.side_count;
        return q.area;
      };
      return (at(h) - at(-h)) / (2 * h);
    };
    for (const bool of_a : {true, false}) {
      const OverlapGradient& g = of_a ? o.gradient_a : o.gradient_b;
      bool same = true;
      const double x = slope({1, 0}, 0, of_a, same), y = slope({0, 1}, 0, of_a, same);
      const double angle = slope({0, 0}, 1, of_a, same);
      if (!same) continue;
      ++checked[o.type];
      ASSERT_NEAR(x, g.translation[0], 4e-9) << text(p);
      ASSERT_NEAR(y, g.translation[1], 4e-9) << text(p);
      ASSERT_NEAR(angle, g.rotation, 4e-9) << text(p);
    }
  }
  for (const OverlapType t :
       {OverlapType::degenerate, OverlapType::i, OverlapType::ii, OverlapType::iii, OverlapType::iv, OverlapType::v})
    EXPECT_GT(checked[t], 4) << name(t);
}

TEST(TriangleOverlap, is_objective) {
  std::mt19937_64 random(8);
  for (int n = 0; n < 3000; ++n) {
    const TrianglePair p = oracle::triangle_pair(PairKind::random, 0, random);
    const TriangleOverlap o = triangle_overlap(p.a, p.b);
    const double angle = 0.1 + n, c = std::cos(angle), s = std::sin(angle);
    const auto turned = [&](Triangle t) {
      for (Vec2& v : t.corner) v = {c * v[0] - s * v[1] + 3, s * v[0] + c * v[1] - 2};
      return t;
    };
    const TriangleOverlap q = triangle_overlap(turned(p.a), turned(p.b));
    ASSERT_NEAR(q.area, o.area, 1e-14) << text(p);
    const Vec2 f = o.gradient_a.translation;
    if (q.type != o.type) continue;
    // corners of nearly parallel edges move by more than the rounding of the turned triangles
    EXPECT_NEAR(q.gradient_a.translation[0], c * f[0] - s * f[1], 1e-11) << text(p);
    EXPECT_NEAR(q.gradient_a.translation[1], s * f[0] + c * f[1], 1e-11) << text(p);
    EXPECT_NEAR(q.gradient_b.rotation, o.gradient_b.rotation, 1e-11) << text(p);
  }
}

TEST(Orientation, is_exact) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  std::uniform_int_distribution<int> exponent(-1020, 1000), small(-2, 2);
  const auto any = [&] { return std::ldexp(coordinate(random), exponent(random)); };
  for (int n = 0; n < 20000; ++n) {
    Vec2 a{any(), any()}, b{any(), any()};
    if (n % 2) a = {coordinate(random), coordinate(random)}, b = {coordinate(random), coordinate(random)};
    Vec2 c = n % 3 ? a + 0.5 * (b - a) : Vec2{any(), any()};
    for (int k = 0; k < 2; ++k)
      for (int u = small(random); u != 0; u -= u > 0 ? 1 : -1) c[k] = std::nextafter(c[k], u * 1e300);
    ASSERT_EQ(orientation_sign(a, b, c), oracle::rational_orientation(a, b, c)) << n;
    ASSERT_EQ(orientation_sign(a, b, a), 0);
  }
}

TEST(PolygonIntersection, agrees_with_the_overlap_of_triangles) {
  std::mt19937_64 random(10);
  for (int n = 0; n < 2000; ++n) {
    const PairKind kind = oracle::kPairKinds[idx(n) % (std::size(oracle::kPairKinds) - 1)];
    const TrianglePair p = oracle::triangle_pair(kind, n / 10 % 2, random);
    if (orientation_sign(p.a.corner[0], p.a.corner[1], p.a.corner[2]) == 0) continue;
    if (orientation_sign(p.b.corner[0], p.b.corner[1], p.b.corner[2]) == 0) continue;
    const PolygonIntersection q = polygon_intersection(p.a.corner, p.b.corner);
    const double area = triangle_overlap(p.a, p.b).area;
    ASSERT_NEAR(q.area, area, 4 * kUnit * area) << text(p);
    ASSERT_EQ(q.parts.size(), area > 0 ? 1u : 0u) << text(p);
  }
}

TEST(PolygonIntersection, of_concave_polygons_has_parts) {
  const std::vector<Vec2> comb{{0, 0}, {5, 0}, {5, 3}, {4, 3}, {4, 1}, {3, 1},
                               {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}};
  const std::vector<Vec2> bar{{-1, 2}, {-1, 4}, {6, 4}, {6, 2}};  // clockwise
  const PolygonIntersection q = polygon_intersection(comb, bar);
  EXPECT_EQ(q.area, 3);
  ASSERT_EQ(q.parts.size(), 3u);
  for (const auto& part : q.parts) EXPECT_EQ(part.size(), 4u);
  const std::vector<Vec2> above{{0, 3}, {5, 3}, {5, 4}};
  EXPECT_EQ(polygon_intersection(comb, above).area, 0);
  EXPECT_TRUE(polygon_intersection(comb, above).parts.empty());
}

TEST(PolygonIntersection, refuses_what_is_not_a_simple_polygon) {
  const std::vector<Vec2> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const std::vector<Vec2> bow{{0, 0}, {1, 1}, {1, 0}, {0, 1}}, two{{0, 0}, {1, 1}}, line{{0, 0}, {1, 1}, {2, 2}};
  const std::vector<Vec2> open{{0, 0}, {1, 0}, {std::nan(""), 1}};
  for (const auto& bad : {bow, two, line, open}) {
    EXPECT_THROW(polygon_intersection(square, bad), std::invalid_argument);
    EXPECT_THROW(polygon_intersection(bad, square), std::invalid_argument);
  }
}

}  // namespace
}  // namespace isostat
