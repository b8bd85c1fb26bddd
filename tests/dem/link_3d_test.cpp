// A link in space: velocities and loads are adjoint, rigid motions are seen by none, rolling pairs roll, and in a plane
// it is the link of the plane.
#include "dem/state/link_3d.hpp"

#include <gtest/gtest.h>

#include <random>

#include "dem/state/balance_3d.hpp"
#include "dem/state/link.hpp"
#include "dem/state/link_ends.hpp"
#include "geometry/base/index.hpp"
#include "tests/support/random_spheres.hpp"

namespace isostat {
namespace {

using V = Real3<double>;

struct Draw {
  std::mt19937_64 random{5};
  std::normal_distribution<> normal;
  V vector() { return {normal(random), normal(random), normal(random)}; }
};

void expect_near(const V& a, const V& b, double rounding) {
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(a[k], b[k], rounding);
}

TEST(Link3, VelocitiesAndLoadsAreAdjoint) {
  Draw draw;
  for (int trial = 0; trial < 50; ++trial) {
    const auto f = link_frame(draw.vector(), 0.7, 0.4);
    const V dv = draw.vector(), wi = draw.vector(), wj = draw.vector(), moment = draw.vector();
    V tangential = draw.vector();
    const double along = dot_3d(tangential, f.n), normal = draw.normal(draw.random);
    for (std::size_t k = 0; k < 3; ++k) tangential[k] -= along * f.n[k];
    const auto v = link_velocity(f, dv, wi, wj);
    const auto load = link_load(f, normal, tangential, moment);
    const double power = normal * v.normal + dot_3d(tangential, v.tangential) + dot_3d(moment, v.rolling);
    EXPECT_NEAR(dot_3d(load.force, dv) + dot_3d(load.moment_i, wi) + dot_3d(load.moment_j, wj), power, 1e-13);
    EXPECT_NEAR(dot_3d(v.tangential, f.n), 0, 1e-14);

    V sum, difference;
    for (std::size_t k = 0; k < 3; ++k) sum[k] = 0.7 * wi[k] + 0.4 * wj[k], difference[k] = wj[k] - wi[k];
    const auto same = pair_velocity<double>(f, dv, sum, difference);
    expect_near(same.tangential, v.tangential, 1e-13);
  }
}

TEST(Link3, RigidRotationsAreNotSeen) {
  Draw draw;
  for (int trial = 0; trial < 20; ++trial) {
    const V r = draw.vector(), w = draw.vector();
    const auto v = link_velocity(link_frame(r, 0.3, 0.9), cross_3d(w, r), w, w);
    EXPECT_NEAR(v.normal, 0, 1e-13);
    expect_near(v.tangential, {}, 1e-13);
    expect_near(v.rolling, {}, 1e-13);
  }
}

// Two wheels on fixed axles along z, of radii .3 and .6, roll on each other when their rims keep pace.
TEST(Link3, GearsRoll) {
  const auto f = link_frame(V{0.9, 0, 0}, 0.3, 0.6);
  expect_near(link_velocity(f, V{}, V{0, 0, 2}, V{0, 0, -1}).tangential, {}, 1e-15);
  expect_near(link_velocity(f, V{}, V{0, 0, 2}, V{0, 0, 0}).tangential, {0, -0.6, 0}, 1e-15);  // t = z x n = y
}

TEST(Link3, InThePlaneIsTheLinkOfThePlane) {
  Draw draw;
  const V r{0.8, -0.5, 0}, dv{0.3, 0.7, 0};
  const auto f = link_frame(r, 0.5, 0.45);
  const auto p = link_frame(0.8, -0.5, 0.5, 0.45);
  EXPECT_DOUBLE_EQ(f.gap, p.gap);
  EXPECT_DOUBLE_EQ(f.lever_i, p.lever_i);
  const V t{p.nx * 0 - p.ny, p.nx, 0};
  const auto v = link_velocity(f, dv, V{0, 0, 1.5}, V{0, 0, -0.25});
  const auto u = link_velocity(p, dv[0], dv[1], 1.5, -0.25);
  EXPECT_NEAR(v.normal, u.normal, 1e-15);
  EXPECT_NEAR(dot_3d(v.tangential, t), u.tangential, 1e-15);
  EXPECT_NEAR(v.rolling[2], u.rolling, 1e-15);
  const auto load = link_load(f, 2.0, V{0.5 * t[0], 0.5 * t[1], 0}, V{0, 0, 0.125});
  const auto plane = link_load(p, 2.0, 0.5, 0.125);
  EXPECT_NEAR(load.force[0], plane.fx, 1e-15);
  EXPECT_NEAR(load.force[1], plane.fy, 1e-15);
  EXPECT_NEAR(load.moment_i[2], plane.moment_i, 1e-15);
  EXPECT_NEAR(load.moment_j[2], plane.moment_j, 1e-15);
}

// Loads without roots are those of unit forces times a positive factor.
TEST(Link3, RationalLoads) {
  Draw draw;
  const V r = draw.vector();
  const double ri = 0.4, rj = 0.7;
  const auto f = link_frame(r, ri, rj);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    V unit{};
    unit[axis] = 1;
    const auto exact = rational_contact(axis, r, ri, rj);
    const auto load = link_load(f, 0.0, unit, V{});
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(exact.force[k], (ri + rj) * load.force[k], 1e-14);
      EXPECT_NEAR(exact.moment_i[k], (ri + rj) * load.moment_i[k], 1e-14);
      EXPECT_NEAR(exact.moment_j[k], (ri + rj) * load.moment_j[k], 1e-14);
    }
    const auto rolling = link_load(f, 0.0, V{}, unit);
    expect_near(rational_rolling<double>(axis).moment_i, rolling.moment_i, 0);
    expect_near(rational_rolling<double>(axis).moment_j, rolling.moment_j, 0);
  }
}

// Forces pushed at the contact points, moments by the cross product, stress pair by pair.
TEST(Balance3, LoadsAreThoseOfForcesAtContactPoints) {
  RandomSpheres o;
  o.size = {3, 3, 2};
  Packing<3> p = random_spheres(o);
  Draw draw;
  for (Link<3>& link : p.links) {
    const Vec3 n{frame(ends(p, link)).n};
    link.normal_force = draw.normal(draw.random);
    link.tangential_force = Vec3{draw.vector()};
    link.tangential_force -= dot(link.tangential_force, n) * n;
    link.moment = Vec3{draw.vector()};
  }
  std::vector<Vec3> force(p.bodies.size()), moment(p.bodies.size());
  std::array<Vec3, 3> virial{};
  for (const Link<3>& link : p.links) {
    const auto i = idx(link.i), j = idx(link.j);
    const Vec3 r = ends(p, link).branch, n = (1 / norm(r)) * r, f = link.normal_force * n + link.tangential_force,
               arm = (p.bodies.radius[i] / (p.bodies.radius[i] + p.bodies.radius[j])) * r;
    force[i] -= f, force[j] += f;
    moment[i] -= Vec3{cross_3d(arm.c, f.c)}, moment[j] += Vec3{cross_3d((arm - r).c, f.c)};
    moment[i] -= link.moment, moment[j] += link.moment;
    for (std::size_t a = 0; a < 3; ++a) virial[a] += f[static_cast<int>(a)] * r;
  }
  const auto loads = net_loads(p);
  for (std::size_t k = 0; k < loads.size(); ++k) {
    expect_near(loads[k].force.c, force[k].c, 1e-12);
    expect_near(loads[k].moment.c, moment[k].c, 1e-12);
  }
  const StressTensor3 stress = measured_stress(p);
  for (std::size_t a = 0; a < 3; ++a) expect_near((p.cell->measure() * stress[a]).c, virial[a].c, 1e-11);
}

}  // namespace
}  // namespace isostat
