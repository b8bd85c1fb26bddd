// The two forms of a row of G, with roots for doubles and rational for exact fields, are one definition.
#include "analysis/rigidity/rows.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "analysis/rigidity/body_network.hpp"
#include "analysis/rigidity/rigidity_matrix.hpp"
#include "tests/support/random_network.hpp"

namespace isostat {
namespace {

void expect_near(const LinkLoad<double>& a, const LinkLoad<double>& b, double scale) {
  const double rounding = 1e-14 * scale;
  EXPECT_NEAR(a.fx, scale * b.fx, rounding);
  EXPECT_NEAR(a.fy, scale * b.fy, rounding);
  EXPECT_NEAR(a.moment_i, scale * b.moment_i, rounding);
  EXPECT_NEAR(a.moment_j, scale * b.moment_j, rounding);
}

TEST(Rows, RationalLoadsAreUnitLoadsScaled) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<> unit(0.1, 1.0);
  for (int trial = 0; trial < 100; ++trial) {
    const double x = unit(random), y = -unit(random), ri = unit(random), rj = unit(random), r = std::hypot(x, y);
    const auto frame = link_frame(x, y, ri, rj);
    const std::array<double, 2> branch = {x, y};
    for (const RowKind kind : kRowKinds)
      expect_near(rational_load(kind, branch, ri, rj), unit_load(kind, frame),
                  ByRow<double>{r, r * (ri + rj), 1}[kind]);
  }
}

// The load of a unit force is the row of the link's velocity: link_load and link_velocity are adjoint.
TEST(Rows, UnitLoadsAreLinkVelocities) {
  const auto frame = link_frame(0.8, -0.7, 0.45, 0.6);
  for (const RowKind kind : kRowKinds) {
    const auto of = [&](double dx, double dy, double spin_i, double spin_j) {
      const auto v = link_velocity(frame, dx, dy, spin_i, spin_j);
      return ByRow<double>{v.normal, v.tangential, v.rolling}[kind];
    };
    const LinkLoad<double> load = unit_load(kind, frame);
    EXPECT_EQ(load.fx, of(1, 0, 0, 0));
    EXPECT_EQ(load.fy, of(0, 1, 0, 0));
    EXPECT_EQ(load.moment_i, of(0, 0, 1, 0));
    EXPECT_EQ(load.moment_j, of(0, 0, 0, 1));
  }
}

// body_rows() of grains that are bodies of their own, with short coordinates: entry by entry the exact image of the
// rows of doubles, scaled, moments moved from the centres to the origin and strains to absolute velocities.
TEST(Rows, OfTheFieldAreThoseOfDoubles) {
  RandomNetwork o;
  o.columns = 5, o.rows = 4, o.coordination = 5, o.distant = o.sliding = 0.2;
  Packing<2> p = random_network(o);
  const auto shorten = [](double x) { return std::ldexp(std::round(std::ldexp(x, 6)), -6); };
  for (Vec2& r : p.bodies.position) r = {{shorten(r[0]), shorten(r[1])}};
  for (double& r : p.bodies.radius) r = shorten(r);
  p.cell->length = {{shorten(p.cell->length[0]), shorten(p.cell->length[1])}};
  RigidBodies bodies = contract_rigid_bodies(p, NetworkLaw::frictionless);  // every grain its own
  const Rows<FirstField> rows = body_rows(p, NetworkLaw::rolling, true, bodies, exact_geometry<FirstField>(p));
  ASSERT_EQ(static_cast<std::int64_t>(rows.size()), row_count(p, NetworkLaw::rolling));
  int strained = 0;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const Link<2>& link = p.links[static_cast<std::size_t>(rows.rows[r].link)];
    const auto i = static_cast<std::size_t>(link.i), j = static_cast<std::size_t>(link.j);
    const Vec2 offset = p.cell->offset(link.shift), xi = p.bodies.position[i], xj = p.bodies.position[j];
    const std::array<double, 2> branch = {xj[0] + offset[0] - xi[0], xj[1] + offset[1] - xi[1]};
    const auto load = rational_load(rows.rows[r].kind, branch, p.bodies.radius[i], p.bodies.radius[j]);  // exact
    const double turn_i = load.moment_i - (xi[0] * load.fy - xi[1] * load.fx),
                 turn_j = load.moment_j + (xj[0] * load.fy - xj[1] * load.fx);
    const auto expect = [&](std::int32_t body, double x, double y, double w) {
      const auto& at = rows.at(r, body);
      EXPECT_EQ(at[0], FirstField::from_double(x));
      EXPECT_EQ(at[1], FirstField::from_double(y));
      EXPECT_EQ(at[2], FirstField::from_double(w));
    };
    expect(bodies.body_of[i], -load.fx, -load.fy, turn_i);
    expect(bodies.body_of[j], load.fx, load.fy, turn_j);
    if (rows.of(r).size() == 3) {
      expect(bodies.count, -offset[0] * load.fx, -offset[1] * load.fy, 0);
      ++strained;
    }
  }
  EXPECT_GT(strained, 10);
}

}  // namespace
}  // namespace isostat
