#include "analysis/rigidity/rigidity_matrix.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "dem/state/link.hpp"
#include "tests/support/random_network.hpp"

namespace isostat {
namespace {

constexpr NetworkLaw kLaws[] = {NetworkLaw::frictionless, NetworkLaw::friction, NetworkLaw::rolling};

Packing<2> mixed_network(std::uint64_t seed) {
  RandomNetwork o;
  o.columns = 7, o.rows = 6, o.coordination = 4, o.seed = seed, o.periodic = seed % 2 == 0;
  o.distant = o.sliding = o.rolling_yielded = o.both_yielded = 0.1;
  return random_network(o);
}

std::vector<double> draw(std::size_t n, std::mt19937_64& random) {
  std::vector<double> v(n);
  for (double& x : v) x = std::normal_distribution<>()(random);
  return v;
}

// Virtual work: f . (G U) = (G^T f) . U. The right scale for rounding is the sum of the magnitudes of the products.
TEST(RigidityMatrix, TransposeIsTheAdjoint) {
  std::mt19937_64 random(1);
  for (std::uint64_t seed = 0; seed < 20; ++seed)
    for (const NetworkLaw law : kLaws) {
      const Packing<2> p = mixed_network(seed);
      const RigidityMatrix g = rigidity_matrix(p, law, p.cell.has_value());
      const auto u = draw(static_cast<std::size_t>(g.columns()), random),
                 f = draw(static_cast<std::size_t>(g.rows()), random);
      const auto gu = g.link_velocities(u), gtf = g.body_forces(f);
      double left = 0, right = 0, scale = 0;
      for (std::size_t r = 0; r < f.size(); ++r) left += f[r] * gu[r], scale += std::abs(f[r] * gu[r]);
      for (std::size_t c = 0; c < u.size(); ++c) right += gtf[c] * u[c], scale += std::abs(gtf[c] * u[c]);
      EXPECT_NEAR(left, right, 1e-14 * scale);
    }
}

// Every row against dem/state/link.hpp applied to the velocities themselves, and G^T f against link_load.
TEST(RigidityMatrix, RowsAreTheLinkVelocitiesOfTheKernels) {
  std::mt19937_64 random(2);
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Packing<2> p = mixed_network(seed);
    const bool cell_free = p.cell.has_value();
    for (std::size_t i = 0; i < p.bodies.size(); ++i) {
      const auto v = draw(3, random);
      p.bodies.velocity[i] = {{v[0], v[1]}}, p.bodies.spin[i] = v[2];
    }
    const Vec2 rate{{0.3, -0.7}};
    const RigidityMatrix g = rigidity_matrix(p, NetworkLaw::rolling, cell_free);
    const auto velocities = g.link_velocities(body_velocities(p, g.layout, rate));
    const auto f = draw(static_cast<std::size_t>(g.rows()), random);
    std::vector<double> forces(static_cast<std::size_t>(g.columns()), 0.0);
    for (std::size_t r = 0; r < f.size(); ++r) {
      const Link<2>& l = p.links[static_cast<std::size_t>(g.link_of_row[r])];
      const auto i = static_cast<std::size_t>(l.i), j = static_cast<std::size_t>(l.j);
      Vec2 d = p.bodies.position[j] - p.bodies.position[i];
      if (p.cell) d += p.cell->offset(l.shift);
      const auto frame = link_frame(d[0], d[1], p.bodies.radius[i], p.bodies.radius[j]);
      Vec2 dv = p.bodies.velocity[j] - p.bodies.velocity[i];
      if (cell_free) dv -= Vec2{{rate[0] * d[0], rate[1] * d[1]}};
      const auto v = link_velocity(frame, dv[0], dv[1], p.bodies.spin[i], p.bodies.spin[j]);
      EXPECT_NEAR(velocities[r], (ByRow<double>{v.normal, v.tangential, v.rolling}[g.kind[r]]), 1e-13);
      const double nf = g.kind[r] == RowKind::normal ? f[r] : 0, tf = g.kind[r] == RowKind::tangential ? f[r] : 0,
                   mf = g.kind[r] == RowKind::rolling ? f[r] : 0;
      const auto load = link_load(frame, nf, tf, mf);
      forces[3 * j] += load.fx, forces[3 * j + 1] += load.fy, forces[3 * j + 2] += load.moment_j;
      forces[3 * i] -= load.fx, forces[3 * i + 1] -= load.fy, forces[3 * i + 2] += load.moment_i;
      if (cell_free) {
        forces[3 * p.bodies.size()] -= load.fx * d[0];
        forces[3 * p.bodies.size() + 1] -= load.fy * d[1];
      }
    }
    const auto assembled = g.body_forces(f);
    for (std::size_t c = 0; c < forces.size(); ++c) EXPECT_NEAR(assembled[c], forces[c], 1e-12);
  }
}

TEST(RigidityMatrix, RigidMotionsOfAnIsolatedPackingAreNull) {
  const Packing<2> p = mixed_network(1);
  ASSERT_FALSE(p.cell);
  const RigidityMatrix g = rigidity_matrix(p, NetworkLaw::rolling, false);
  std::vector<double> u(static_cast<std::size_t>(g.columns()));
  for (std::size_t i = 0; i < p.bodies.size(); ++i) {
    const Vec2 r = p.bodies.position[i];
    u[3 * i] = 2 - 3 * r[1], u[3 * i + 1] = -1 + 3 * r[0], u[3 * i + 2] = 3;
  }
  for (double v : g.link_velocities(u)) EXPECT_NEAR(v, 0, 1e-12);
}

}  // namespace
}  // namespace isostat
