// H and K of packings of spheres against elimination over the rationals.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "analysis/rigidity/exact_rank.hpp"
#include "analysis/rigidity/rigid_spheres.hpp"
#include "dem/input_error.hpp"
#include "tests/oracle/rational_rank.hpp"
#include "tests/support/random_spheres.hpp"

namespace isostat {
namespace {

constexpr NetworkLaw kLaws[] = {NetworkLaw::frictionless, NetworkLaw::friction, NetworkLaw::rolling};

void expect_rational(const Packing<3>& p) {
  for (const NetworkLaw law : kLaws)
    for (const bool cell_free : {false, true}) {
      if (cell_free && !p.cell) continue;
      SCOPED_TRACE(std::string(name_of(law)) + (cell_free ? " free" : " fixed"));
      const ExactRank r = exact_rank(p, law, cell_free);
      EXPECT_EQ(r.rank, rational_rank(p, law, cell_free));
      EXPECT_EQ(r.dofs, static_cast<std::int64_t>(count_free(p)) * (law == NetworkLaw::frictionless ? 3 : 6) +
                            (cell_free ? 3 : 0));
      EXPECT_EQ(r.dofs + r.hyperstatic, r.rows + r.floppy);
      EXPECT_TRUE(r.certified);
      EXPECT_LE(r.floppy_generic, r.floppy);
      EXPECT_GE(r.mechanisms, 0);
    }
}

Packing<3> spheres_at(const std::vector<Vec3>& centres, double radius) {
  Packing<3> p;
  p.bodies.resize(centres.size());
  for (std::size_t k = 0; k < centres.size(); ++k)
    p.bodies.id[k] = static_cast<std::int64_t>(k), p.bodies.position[k] = centres[k], p.bodies.radius[k] = radius;
  return p;
}
void join(Packing<3>& p, int i, int j, ImageShift<3> shift = {}, LinkKind kind = LinkKind::closed) {
  Link<3> link;
  link.i = i, link.j = j, link.shift = shift, link.kind = kind;
  p.links.push_back(link);
}

TEST(SphereRank, EqualsRationalElimination) {
  int glued = 0, special = 0;
  for (int trial = 0; trial < 60; ++trial) {
    std::mt19937_64 random(static_cast<std::uint64_t>(trial) + 7);
    RandomSpheres o;
    for (int& n : o.size) n = 1 + static_cast<int>(random() % 3);
    o.periodic = trial % 2 == 0;
    o.coordination = std::uniform_real_distribution<>(2.0, 12.0)(random);
    o.jitter = trial % 5 < 2 ? 0.0 : 0.4;
    o.equal_radii = trial % 7 == 0;
    if (trial % 3 == 0) o.distant = o.sliding = o.rolling_yielded = o.both_yielded = 0.08;
    o.tilt = trial % 4 == 0 ? 0.375 + 0.5 * (trial % 3) : 0.0;
    o.seed = static_cast<std::uint64_t>(trial) + 1;
    const Packing<3> p = random_spheres(o);
    SCOPED_TRACE(trial);
    expect_rational(p);
    const auto count = static_cast<std::int32_t>(p.bodies.size());
    glued += contract_rigid_bodies(SphereNetwork(p), NetworkLaw::friction).count < count;
    special += !exact_rank(p, NetworkLaw::friction, false).bounds_meet;
  }
  EXPECT_GT(glued, 2);  // the contraction has been used
  EXPECT_GT(special, 0);
}

TEST(SphereRank, OfLargerNetworks) {
  for (const double coordination : {4.5, 6.0}) {
    RandomSpheres o;
    o.size = {4, 3, 3}, o.coordination = coordination, o.seed = 3;
    const Packing<3> p = random_spheres(o);
    EXPECT_EQ(exact_rank(p, NetworkLaw::friction, true).rank, rational_rank(p, NetworkLaw::friction, true));
  }
}

TEST(SphereRank, FewSpheres) {
  Packing<3> none = spheres_at({{{0, 0, 0}}}, 0.5);
  expect_rational(none);
  EXPECT_EQ(exact_rank(none, NetworkLaw::friction, false).trivial, 6);
  EXPECT_EQ(exact_rank(none, NetworkLaw::frictionless, false).trivial, 3);

  // A pair: normal 1, tangential 2; as points they have 5 motions of the whole.
  Packing<3> pair = spheres_at({{{0, 0, 0}}, {{1, 0, 0}}}, 0.5);
  join(pair, 0, 1);
  expect_rational(pair);
  EXPECT_EQ(exact_rank(pair, NetworkLaw::frictionless, false).trivial, 5);
  EXPECT_EQ(exact_rank(pair, NetworkLaw::frictionless, false).mechanisms, 0);
  EXPECT_EQ(exact_rank(pair, NetworkLaw::friction, false).floppy, 9);
  EXPECT_EQ(exact_rank(pair, NetworkLaw::rolling, false).floppy, 6);

  // A straight chain of points keeps 5 trivial motions, a bent one has 6.
  Packing<3> chain = spheres_at({{{0, 0, 0}}, {{1, 0, 0}}, {{2, 0, 0}}, {{3, 0, 0}}}, 0.5);
  for (int k = 0; k < 3; ++k) join(chain, k, k + 1);
  expect_rational(chain);
  EXPECT_EQ(exact_rank(chain, NetworkLaw::frictionless, false).trivial, 5);
  chain.bodies.position[3] = {{2, 1, 0}};
  expect_rational(chain);
  EXPECT_EQ(exact_rank(chain, NetworkLaw::frictionless, false).trivial, 6);
}

// Four spheres that touch each other: as points a rigid tetrahedron; with friction 24 dofs, 18 rows.
TEST(SphereRank, Tetrahedron) {
  Packing<3> p = spheres_at({{{0, 0, 0}}, {{1, 1, 0}}, {{1, 0, 1}}, {{0, 1, 1}}}, std::sqrt(0.5));
  for (int i = 0; i < 4; ++i)
    for (int j = i + 1; j < 4; ++j) join(p, i, j);
  expect_rational(p);
  EXPECT_EQ(exact_rank(p, NetworkLaw::frictionless, false).floppy, 6);
  EXPECT_EQ(exact_rank(p, NetworkLaw::frictionless, false).hyperstatic, 0);
}

// Even rings turn like gears about any axis: three null vectors of the spins alone. Odd ones do not.
TEST(SphereRank, RingsOfGears) {
  for (const int n : {4, 5, 6}) {
    std::vector<Vec3> centres;
    for (int k = 0; k < n; ++k)
      centres.push_back({{std::round(64 * std::cos(k * 6.283185307179586 / n)) / 32,
                          std::round(64 * std::sin(k * 6.283185307179586 / n)) / 32, k % 2 * 0.25}});
    Packing<3> p = spheres_at(centres, 0.5);
    for (int k = 0; k < n; ++k) join(p, k, (k + 1) % n);
    SCOPED_TRACE(n);
    expect_rational(p);
    const auto gears = gear_components(SphereNetwork(p), NetworkLaw::friction);
    EXPECT_EQ(gears.size(), n % 2 == 0 ? 1u : 0u);
    EXPECT_TRUE(gear_components(SphereNetwork(p), NetworkLaw::rolling).empty());
  }
}

TEST(SphereRank, SeveralImagesOfOnePair) {
  Packing<3> p = spheres_at({{{0.25, 0.5, 0.125}}, {{0.75, 0.25, 0.5}}}, 0.375);
  p.cell = PeriodicCell<3>{{{1, 1.25, 1.5}}};
  for (const ImageShift<3> s : {ImageShift<3>{0, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {-1, 0, -1}, {2, -1, 1}}) {
    join(p, 0, 1, s, s[0] == -1 ? LinkKind::sliding : LinkKind::closed);
    expect_rational(p);
  }
  join(p, 0, 0, {1, 0, 0});
  join(p, 1, 1, {0, 1, -1});
  expect_rational(p);
}

// A crystal: special positions, where the bound for generic ones stays below.
TEST(SphereRank, Crystals) {
  for (const double coordination : {26.0, 12.0}) {
    RandomSpheres o;
    o.size = {3, 3, 2}, o.jitter = 0, o.equal_radii = true, o.coordination = coordination, o.seed = 11;
    expect_rational(random_spheres(o));
  }
}

TEST(SphereRank, WallsHold) {
  Packing<3> p = spheres_at({{{0, 0, 1}}, {{1, 0, 1}}, {{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}}, 0.5);
  p.part = {GrainPart::free, GrainPart::free, GrainPart::wall, GrainPart::wall, GrainPart::wall};
  join(p, 0, 2), join(p, 0, 3), join(p, 0, 4), join(p, 0, 1), join(p, 1, 3);
  for (const NetworkLaw law : kLaws) {
    const ExactRank r = exact_rank(p, law, false);
    EXPECT_EQ(r.rank, rational_rank(p, law, false));
    EXPECT_EQ(r.trivial, 0);
  }
}

// Copies side by side: every motion of one is a motion of all, and each copy has its own.
TEST(SphereRank, OfCopies) {
  RandomSpheres o;
  o.size = {8, 8, 8}, o.coordination = 6.5, o.seed = 4;
  const Packing<3> one = random_spheres(o), eight = replicated(one, 2);
  for (const NetworkLaw law : {NetworkLaw::friction, NetworkLaw::rolling}) {
    const ExactRank r = exact_rank(one, law, false), s = exact_rank(eight, law, false);
    EXPECT_TRUE(r.certified && s.certified);
    EXPECT_GE(s.floppy, r.floppy);
    EXPECT_LE(s.floppy, 8 * r.floppy);
    EXPECT_EQ(s.rows, 8 * r.rows);
  }
  EXPECT_LT(contract_rigid_bodies(SphereNetwork(eight), NetworkLaw::friction).count, 512);  // of 4096 spheres
}

TEST(SphereRank, FreeCellNeedsACell) {
  Packing<3> p = spheres_at({{{0, 0, 0}}}, 0.5);
  EXPECT_THROW(exact_rank(SphereNetwork(p), NetworkLaw::friction, true), InputError);
}

}  // namespace
}  // namespace isostat
