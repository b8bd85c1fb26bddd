// The contact force of Poeschel and Buchholtz 1995, Sec. 3, against cases computed by hand, and in the worst company.
#include "dem/triangles/paper_contact.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "geometry/triangle_mesh.hpp"
#include "tests/support/triangle_pairs.hpp"

namespace isostat {
namespace {

constexpr double kY = 2e7;  // [g/(cm s^2)]

double cross(const Vec2& u, const Vec2& v) { return u[0] * v[1] - u[1] * v[0]; }
Vec2 centroid(const Triangle& t) { return (1.0 / 3) * (t.corner[0] + t.corner[1] + t.corner[2]); }
double area(const Triangle& t) { return 0.5 * std::abs(doubled_area(t.corner[0], t.corner[1], t.corner[2])); }

void expect_force(const Triangle& a, const Triangle& b, OverlapType type, const Vec2& on_a, const Vec2& at) {
  ASSERT_EQ(overlap_type(a, b), type);
  const PaperContact c = paper_contact(a, b, kY);
  EXPECT_NEAR(c.on_a[0], kY * on_a[0], 1e-12 * kY);
  EXPECT_NEAR(c.on_a[1], kY * on_a[1], 1e-12 * kY);
  EXPECT_NEAR(c.moment_a, kY * cross(at - centroid(a), on_a), 1e-12 * kY);
  EXPECT_NEAR(c.moment_b, -kY * cross(at - centroid(b), on_a), 1e-12 * kY);
  const PaperContact other = paper_contact(b, a, kY);
  EXPECT_NEAR(other.on_a[0], -c.on_a[0], 1e-12 * kY);
  EXPECT_NEAR(other.on_a[1], -c.on_a[1], 1e-12 * kY);
}

const Triangle kFloor{{{{{-10, 0}}, {{0, -10}}, {{10, 0}}}}};  // its upper side is y = 0

// A corner under 45 degrees, .1 deep: D = .1 * .1 / 2.
TEST(PaperContact, TypeI) {
  const Triangle wedge{{{{{0.3, -0.1}}, {{2.3, 1.9}}, {{0.3, 1.9}}}}};
  expect_force(wedge, kFloor, OverlapType::i, {{0, 0.005}}, {{0.35, 0}});
}

// Nearly all of the triangle has sunk in: the part outside is the smaller one, and the force still points out.
TEST(PaperContact, TypeIBeyondHalfTheTriangle) {
  const Triangle sunk{{{{{-1, -0.9}}, {{1, -0.9}}, {{0, 0.1}}}}};
  expect_force(sunk, kFloor, OverlapType::i, {{0, 0.01}}, {{0, 0}});
}

// Corner against corner, right angles .1 deep on either side of S1S2, which lies on y = 0.
TEST(PaperContact, TypeII) {
  const Triangle upper{{{{{0, -0.1}}, {{1, 0.9}}, {{-1, 0.9}}}}}, lower{{{{{0, 0.1}}, {{-2, -1.9}}, {{2, -1.9}}}}};
  expect_force(upper, lower, OverlapType::ii, {{0, 0.02}}, {{0, 0}});
}

// Deep: a corner of the first is inside the second, of which two corners have gone into the first. The second has come
// in through the corner of the first at the origin and is pushed back out to the left.
TEST(PaperContact, TypeIIBeyondHalfTheTriangle) {
  const Triangle large{{{{{0, 0}}, {{4, -2}}, {{4, 2}}}}}, small{{{{{-0.5, 0.1}}, {{1, -0.3}}, {{1, 0.3}}}}};
  ASSERT_EQ(overlap_type(large, small), OverlapType::ii);
  const PaperContact c = paper_contact(large, small, kY), other = paper_contact(small, large, kY);
  EXPECT_GT(c.on_a[0], 0);
  for (int k = 0; k < 2; ++k) EXPECT_NEAR(other.on_a[k], -c.on_a[k], 1e-12 * kY);
}

// A spike whose tip has come through a corner of the other: sides x = +-(y + 2)/4 against y = 0 and x = +-(y + 1).
// The side y = 0 cuts 1 off the spike; each side of the spike cuts a corner of area 1/6 off the other, of half base 1/2
// and height 2/3.
TEST(PaperContact, TypeIV) {
  const Triangle spike{{{{{0, -2}}, {{1, 2}}, {{-1, 2}}}}}, wedge{{{{{-1, 0}}, {{0, -1}}, {{1, 0}}}}};
  expect_force(spike, wedge, OverlapType::iv, {{0, 1 + 1 / (3 * std::sqrt(17.0))}}, {{0, 0}});
}

// A star of David, one triangle raised by d: it cuts equilateral corners of heights 1/2 - d, 1/2 + d/2, 1/2 + d/2 off
// the other, of area h^2/sqrt 3, and the other does the same to it.
TEST(PaperContact, TypeV) {
  const double r = std::sqrt(3.0) / 2, d = 0.1;
  const Triangle up{{{{{0, 1}}, {{-r, -0.5}}, {{r, -0.5}}}}}, down{{{{{0, -1 + d}}, {{r, 0.5 + d}}, {{-r, 0.5 + d}}}}};
  ASSERT_EQ(overlap_type(up, down), OverlapType::v);
  const PaperContact c = paper_contact(up, down, kY);
  const double high = (0.5 - d) * (0.5 - d), low = (0.5 + d / 2) * (0.5 + d / 2);
  EXPECT_NEAR(c.on_a[0], 0, 1e-12 * kY);
  EXPECT_NEAR(c.on_a[1], 2 * kY * (high - low) / std::sqrt(3.0), 1e-12 * kY);
}

// Two bars across each other, sides y = +-(5 - x)/100 and x = +-(5 - y)/100: Y/2 times their common area on one side of
// each. The first lies to the left of the second and higher, so that its lower side is pushed up and the left side of
// the other pushes it to the left.
TEST(PaperContact, TypeIII) {
  const Triangle bar{{{{{-5, -0.1}}, {{5, 0}}, {{-5, 0.1}}}}}, across{{{{{0.1, -5}}, {{0, 5}}, {{-0.1, -5}}}}};
  ASSERT_EQ(overlap_type(bar, across), OverlapType::iii);
  const auto crossing = [](int sign_x, int sign_y) {
    const double q = sign_x * sign_y;
    return Vec2{{(0.05 * sign_x - 5e-4 * q) / (1 - 1e-4 * q), (0.05 * sign_y - 5e-4 * q) / (1 - 1e-4 * q)}};
  };
  const Vec2 s1 = crossing(-1, -1), s2 = crossing(1, -1), s3 = crossing(1, 1), s4 = crossing(-1, 1);
  const double common = 0.5 * (cross(s2 - s1, s3 - s1) + cross(s3 - s1, s4 - s1));
  const double force = 0.5 * common / std::sqrt(1.0001);
  const Vec2 up{{-0.01 * force, force}}, left{{-force, 0.01 * force}}, under = 0.5 * (s1 + s2),
                                                                       beside = 0.5 * (s1 + s4);
  const auto moment = [&](const Vec2& g) { return kY * (cross(under - g, up) + cross(beside - g, left)); };
  for (int turn_a = 0; turn_a < 3; ++turn_a)  // wherever the corners begin, whichever comes first
    for (int turn_b = 0; turn_b < 3; ++turn_b) {
      Triangle a = bar, b = across;
      std::rotate(a.corner.begin(), a.corner.begin() + turn_a, a.corner.end());
      std::rotate(b.corner.begin(), b.corner.begin() + turn_b, b.corner.end());
      const PaperContact c = paper_contact(a, b, kY), other = paper_contact(b, a, kY);
      for (int k = 0; k < 2; ++k) {
        EXPECT_NEAR(c.on_a[k], kY * (up + left)[k], 1e-12 * kY);
        EXPECT_NEAR(other.on_a[k], -kY * (up + left)[k], 1e-12 * kY);
      }
      EXPECT_NEAR(c.moment_a, moment(centroid(bar)), 1e-12 * kY);
      EXPECT_NEAR(c.moment_b, -moment(centroid(across)), 1e-12 * kY);
      EXPECT_NEAR(other.moment_a, c.moment_b, 1e-12 * kY);
    }
}

// A corner on the line of an edge far away is a special position by sign, and changes nothing.
TEST(PaperContact, SpecialPositionsAreTheLimitOfTheirNeighbours) {
  // The left side of the wedge points at a corner of the floor.
  for (const double shift : {-1e-7, 0.0, 1e-7}) {
    const Triangle floor{{{{{-10, 0}}, {{0, -10}}, {{10, 0}}}}};
    const Triangle wedge{{{{{0 + shift, -0.1}}, {{2, 1.9}}, {{0, 1.9}}}}};
    const Triangle below{{{{{-9, 0.0}}, {{0, -10}}, {{11, 0}}}}};
    const PaperContact c = paper_contact(wedge, below, kY), far = paper_contact(wedge, floor, kY);
    EXPECT_NEAR(c.on_a[1], 0.005 * kY, 1e-6 * kY) << shift;
    EXPECT_NEAR(far.on_a[1], 0.005 * kY, 1e-6 * kY) << shift;
    EXPECT_NEAR(far.moment_a, (0.05 - 2.0 / 3) * 0.005 * kY, 1e-6 * kY) << shift;
  }
}

TEST(PaperContact, OneInsideTheOtherMeetsNoForce) {
  const Triangle inside{{{{{0, -2}}, {{1, -1.5}}, {{0, -1}}}}};
  EXPECT_EQ(norm(paper_contact(inside, kFloor, kY).on_a), 0);
  EXPECT_EQ(paper_contact(kFloor, inside, kY).moment_a, 0);
  // Whose edges add up to zero but for rounding.
  const Triangle small{{{{{0.1, -2.1}}, {{1.3, -1.7}}, {{0.3, -1.3}}}}};
  EXPECT_EQ(norm(paper_contact(small, kFloor, kY).on_a), 0);
  EXPECT_EQ(norm(paper_contact(kFloor, small, kY).on_a), 0);
}

// No pair, however deep or flat, has a force beyond Y times the areas, a force without its opposite, or a couple out of
// nothing. Each triangle has three edges at most, and no edge cuts off more than half.
TEST(PaperContact, NeverExplodes) {
  std::mt19937_64 random(3);
  for (const oracle::PairKind kind : oracle::kPairKinds)
    for (int nudge : {0, 1, 3})
      for (int k = 0; k < 3000; ++k) {
        auto [a, b] = oracle::triangle_pair(kind, nudge, random);
        for (Triangle* t : {&a, &b})
          if (doubled_area(t->corner[0], t->corner[1], t->corner[2]) < 0) std::swap(t->corner[1], t->corner[2]);
        if (!(area(a) > 0) || !(area(b) > 0)) continue;
        const PaperContact c = paper_contact(a, b, kY), other = paper_contact(b, a, kY);
        ASSERT_TRUE(std::isfinite(c.on_a[0] + c.on_a[1] + c.moment_a + c.moment_b)) << name(kind) << k;
        const double most = 1.5 * kY * (area(a) + area(b));
        ASSERT_LE(norm(c.on_a), most * (1 + 1e-9)) << name(kind) << k;
        // Whichever comes first; edges that coincide but for rounding cross anywhere.
        if (kind == oracle::PairKind::random || kind == oracle::PairKind::shallow ||
            kind == oracle::PairKind::on_edge) {
          ASSERT_LE(norm(c.on_a + other.on_a), 1e-6 * most) << name(kind) << k << " " << name(overlap_type(a, b));
        }
        double extent = 0;
        for (const Triangle* t : {&a, &b})
          for (const Triangle* u : {&a, &b})
            for (const Vec2& q : t->corner) extent = std::max(extent, norm(q - centroid(*u)));
        ASSERT_LE(std::max(std::abs(c.moment_a), std::abs(c.moment_b)), extent * most * (1 + 1e-9)) << name(kind) << k;
        ASSERT_LE(std::abs(c.moment_a + c.moment_b + cross(centroid(a) - centroid(b), c.on_a)), 1e-9 * most)
            << name(kind) << k;
      }
}

}  // namespace
}  // namespace isostat
