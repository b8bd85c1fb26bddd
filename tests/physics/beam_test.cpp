// The beam of REDESIGN 3.4 as a link: its force is the gradient of its energy, its tangent that of its force.
#include "dem/state/beam.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "analysis/stiffness/link_tangent.hpp"
#include "analysis/stiffness/stiffness_matrix.hpp"
#include "dem/state/link_ends.hpp"

namespace isostat {
namespace {

// Bodies x, y, angle; each beam knows the directions of its ends in the frames of its bodies at angle 0.
struct Frame {
  struct Join {
    std::size_t i, j;
    Vec2 end_i, end_j;
    Beam beam;
  };
  std::vector<std::array<double, 3>> body;
  std::vector<Join> joins;
};

Vec2 turned(const Vec2& v, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {{c * v[0] - s * v[1], s * v[0] + c * v[1]}};
}

struct Shape {
  Vec2 chord;
  double length, turn_i, turn_j;
};
Shape shape_of(const Frame& f, const Frame::Join& join) {
  const auto &a = f.body[join.i], &b = f.body[join.j];
  const Vec2 chord{{b[0] - a[0], b[1] - a[1]}};
  return {chord, norm(chord), end_rotation(turned(join.end_i, a[2]), chord) - join.beam.rest_angle_i,
          end_rotation(turned(join.end_j, b[2]), chord) - join.beam.rest_angle_j};
}

// As links of a packing, with their forces.
Packing<2> packing_of(const Frame& f) {
  Packing<2> p;
  p.bodies.resize(f.body.size());
  for (std::size_t i = 0; i < f.body.size(); ++i) {
    p.bodies.id[i] = static_cast<std::int64_t>(i);
    p.bodies.position[i] = {{f.body[i][0], f.body[i][1]}};
    p.bodies.radius[i] = 0.1 + 0.05 * static_cast<double>(i);  // must not matter
  }
  for (const Frame::Join& join : f.joins) {
    const Shape s = shape_of(f, join);
    const BeamForce force = beam_force(join.beam, s.length, s.turn_i, s.turn_j);
    Link<2> link;
    link.i = static_cast<std::int32_t>(join.i), link.j = static_cast<std::int32_t>(join.j);
    link.kind = LinkKind::beam, link.beam = static_cast<std::int32_t>(p.beams.size());
    link.gap = s.length - join.beam.rest_length;
    link.normal_force = force.normal, link.tangential_force = force.tangential, link.moment = force.moment;
    p.beams.push_back(join.beam), p.links.push_back(link);
  }
  return p;
}

std::vector<double> body_forces(const Frame& f) {
  const Packing<2> p = packing_of(f);
  std::vector<double> forces(3 * f.body.size(), 0.0);
  for (const Link<2>& l : p.links) {
    const auto i = static_cast<std::size_t>(l.i), j = static_cast<std::size_t>(l.j);
    const auto load = link_load(frame(ends(p, l)), l.normal_force, l.tangential_force, l.moment);
    forces[3 * i] -= load.fx, forces[3 * i + 1] -= load.fy, forces[3 * i + 2] += load.moment_i;
    forces[3 * j] += load.fx, forces[3 * j + 1] += load.fy, forces[3 * j + 2] += load.moment_j;
  }
  return forces;
}

double energy(const Frame& f) {
  double sum = 0;
  for (const Frame::Join& join : f.joins) {
    const Shape s = shape_of(f, join);
    sum += beam_energy(join.beam, s.length, s.turn_i, s.turn_j);
  }
  return sum;
}

// A loop with a tail, strongly loaded: strains and rotations of order one tenth to one.
Frame loaded_frame(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<> unit(-1.0, 1.0);
  Frame f;
  for (const Vec2& r : {Vec2{{0, 0}}, Vec2{{1, 0.1}}, Vec2{{0.7, 1}}, Vec2{{2, 0.4}}})
    f.body.push_back({r[0] + 0.1 * unit(random), r[1] + 0.1 * unit(random), 3 * unit(random)});
  for (const auto& [i, j] : {std::pair<std::size_t, std::size_t>{0, 1}, {2, 1}, {2, 0}, {3, 1}}) {
    const Vec2 chord{{f.body[j][0] - f.body[i][0], f.body[j][1] - f.body[i][1]}};
    Frame::Join join;
    join.i = i, join.j = j;
    join.end_i = turned(chord, 0.4 * unit(random) - f.body[i][2]);
    join.end_j = turned(chord, 0.4 * unit(random) - f.body[j][2]);
    join.beam = {norm(chord) * (1 + 0.2 * unit(random)), 0.1 * unit(random), 0.1 * unit(random), 5 + unit(random),
                 0.8 + 0.3 * unit(random)};
    f.joins.push_back(join);
  }
  return f;
}

// Fourth-order central difference of a function of one coordinate.
double slope(Frame f, std::size_t dof, const std::function<double(const Frame&)>& of) {
  constexpr double h = 1e-3;
  const auto at = [&](double by) {
    Frame moved = f;
    moved.body[dof / 3][dof % 3] += by;
    return of(moved);
  };
  return (8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h);
}

TEST(Beam, ForcesAreTheGradientOfTheEnergy) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Frame f = loaded_frame(seed);
    const std::vector<double> forces = body_forces(f);
    for (std::size_t d = 0; d < forces.size(); ++d) EXPECT_NEAR(forces[d], -slope(f, d, energy), 1e-9);
  }
}

// Poeschel and Buchholtz 1995, Eqs. 42-49: M_A = -(EI/L0) (4 T_a + 2 T_b), and so on B; the lever arms give the shear
// force.
TEST(Beam, EndMoments) {
  const Beam beam{1.3, 0, 0, 7, 2};
  const double length = 1.7, turn_i = 0.3, turn_j = -0.11, bend = beam.bending / beam.rest_length;
  const BeamForce f = beam_force(beam, length, turn_i, turn_j);
  const auto load =
      link_load(link_frame(length, 0.0, beam.rest_length / 2, beam.rest_length / 2), f.normal, f.tangential, f.moment);
  EXPECT_NEAR(load.moment_i, -bend * (4 * turn_i + 2 * turn_j), 1e-14);
  EXPECT_NEAR(load.moment_j, -bend * (4 * turn_j + 2 * turn_i), 1e-14);
  EXPECT_NEAR(load.fx, -7 * 0.4, 1e-14);
  EXPECT_NEAR(load.moment_i + load.moment_j + length * load.fy, 0, 1e-14);  // no net torque
}

// The tangent of the analysis against finite differences of the forces; symmetric, for the beams have an energy.
TEST(Beam, TangentIsTheDerivativeOfTheForces) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Frame f = loaded_frame(seed);
    const UnsymmetricMatrix tangent = tangent_stiffness(packing_of(f), NetworkLaw::frictionless, default_network_law());
    ASSERT_EQ(static_cast<std::size_t>(tangent.size), 3 * f.body.size());
    std::vector<double> dense(static_cast<std::size_t>(tangent.size) * static_cast<std::size_t>(tangent.size), 0.0);
    const std::size_t n = 3 * f.body.size();
    double largest = 0;
    for (std::size_t c = 0; c < n; ++c)
      for (auto e = static_cast<std::size_t>(tangent.start[c]); e < static_cast<std::size_t>(tangent.start[c + 1]); ++e)
        dense[static_cast<std::size_t>(tangent.row[e]) * n + c] = tangent.value[e],
                                                             largest = std::max(largest, std::abs(tangent.value[e]));
    for (std::size_t c = 0; c < n; ++c)
      for (std::size_t r = 0; r < n; ++r) {
        EXPECT_NEAR(dense[r * n + c], -slope(f, c, [r](const Frame& g) { return body_forces(g)[r]; }), 1e-8);
        EXPECT_NEAR(dense[r * n + c], dense[c * n + r], 1e-13 * largest);
      }
  }
}

// Without load the tangent is G^T k G, whatever the rest angles.
TEST(Beam, StiffnessOfItsRows) {
  const BeamStiffness k = beam_stiffness({0.5, 0.2, -0.1, 3, 2}, 0.8);
  EXPECT_EQ(k.normal, 3);
  EXPECT_DOUBLE_EQ(k.tangential, 12 * 2 / (0.5 * 0.8 * 0.8));
  EXPECT_DOUBLE_EQ(k.rolling, 4);
}

}  // namespace
}  // namespace isostat
