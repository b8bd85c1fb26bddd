// Stiffness, dampers and frequencies of a free grain: closed forms of the square (docs of the formulas beside the
// checks), finite differences of the energy, Appendix A of Poeschel and Buchholtz 1995, and balance of the dampers.
#include "dem/triangles/grain_spectrum.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <numbers>

#include "dem/triangles/grain_shape.hpp"
#include "tests/dem/triangles/moving_grain.hpp"

namespace isostat {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

GrainTemplate grain_of(const char* shape, double size = 0.1) { return grain_template(grain_shape(shape, size), {}); }

MatrixXd matrix(const std::vector<double>& m) {
  const auto n = static_cast<Eigen::Index>(std::lround(std::sqrt(static_cast<double>(m.size()))));
  return Eigen::Map<const MatrixXd>(m.data(), n, n);  // symmetric
}

// The square of side s: m = rho s^2/4, J = m s^2/18, L = sqrt(2) s/3, centroids at s/3 from the centre.
struct Square {
  explicit Square(double s) : m(s * s / 4), j(m * s * s / 18), length(std::numbers::sqrt2 * s / 3) {}
  double m, j, length;
  double spin() const { return std::sqrt(12 * 10 / length * 1.5 / j); }  // all turn alike, the ring turns back by half
  double breathing() const { return std::sqrt(2 * 1e5 / m); }
};

double nearest(const std::vector<double>& omega, double w) {
  return *std::min_element(omega.begin(), omega.end(),
                           [w](double a, double b) { return std::abs(a - w) < std::abs(b - w); });
}

TEST(GrainSpectrum, SquareHasItsSpinAndBreathingModes) {
  for (const double s : {0.07, 0.1, 0.14, 0.2}) {
    const Square square(s);
    const std::vector<double> omega = grain_frequencies(grain_of("square", s));
    ASSERT_EQ(omega.size(), 12u);
    for (int k = 0; k < 3; ++k) EXPECT_EQ(omega[idx(k)], 0) << "rigid motions";
    EXPECT_GT(omega[3], 1e3);
    EXPECT_TRUE(std::is_sorted(omega.begin(), omega.end()));
    EXPECT_NEAR(omega.back() / square.spin(), 1, 1e-13);
    EXPECT_NEAR(nearest(omega, square.breathing()) / square.breathing(), 1, 1e-13);
  }
  EXPECT_NEAR(grain_frequencies(grain_of("square", 0.1)).back(), 52400, 50);  // TRIANGLES.md 5
}

// Decay rates d of v exp(-d t) for modes that the dampers leave alone: C v = 2 d M v.
TEST(GrainSpectrum, DecayRatesOfTheSquare) {
  for (const double s : {0.07, 0.1, 0.14}) {
    const Square square(s);
    const GrainTemplate grain = grain_of("square", s);
    const GrainMatrices m = grain_matrices(grain);
    const MatrixXd damping = matrix(m.damping);
    const VectorXd mass = Eigen::Map<const VectorXd>(m.mass.data(), 12);
    VectorXd breathing(12), spin(12);
    for (Eigen::Index t = 0; t < 4; ++t) {
      const Vec2 r = grain.triangles[idx(t)].centroid;
      breathing.segment<3>(3 * t) << r[0], r[1], 0;
      spin.segment<3>(3 * t) << 0.5 * r[1], -0.5 * r[0], 1;
    }
    const double gamma = 9, moment = 10 / 1e5;  // [g/s], I [cm^3]
    const double breathing_decay = gamma / square.m;
    const double spin_decay = 1.5 * gamma * moment / (square.length * square.j);
    EXPECT_LT((damping * breathing - 2 * breathing_decay * mass.cwiseProduct(breathing)).norm(),
              1e-13 * (damping * breathing).norm());
    EXPECT_LT((damping * spin - 2 * spin_decay * mass.cwiseProduct(spin)).norm(), 1e-13 * (damping * spin).norm());
    // TRIANGLES.md 5 estimates zeta of the spin mode by the diagonal of C, two thirds of it: .11, .26, .62
    const double diagonal = spin_decay / square.spin() / 1.5;
    EXPECT_NEAR(diagonal, s == 0.14 ? 0.11 : s == 0.1 ? 0.26 : 0.62, 0.025);
  }
}

// A triangle without beams only moves rigidly; a chain of beams holds the grain together with nothing to spare.
TEST(GrainSpectrum, ThreeRigidMotionsWhateverTheShape) {
  for (const char* shape : {"triangle", "polygon3", "polygon6", "polygon24", "rod", "L", "star"}) {
    const std::vector<double> omega = grain_frequencies(grain_of(shape));
    EXPECT_EQ(std::count(omega.begin(), omega.end(), 0.0), 3) << shape;
  }
}

// omega^2 is the spectrum of M^-1/2 K M^-1/2, by another factorisation.
TEST(GrainSpectrum, EqualsTheEigenvaluesOfStiffness) {
  for (const char* shape : {"square", "polygon5", "rod", "L", "star"}) {
    const GrainTemplate grain = grain_of(shape);
    const GrainMatrices m = grain_matrices(grain);
    const VectorXd scale = Eigen::Map<const VectorXd>(m.mass.data(), static_cast<Eigen::Index>(m.size)).cwiseSqrt();
    const VectorXd inverse = scale.cwiseInverse();
    const MatrixXd scaled = inverse.asDiagonal() * matrix(m.stiffness) * inverse.asDiagonal();
    const VectorXd values = Eigen::SelfAdjointEigenSolver<MatrixXd>(scaled).eigenvalues();
    const std::vector<double> omega = grain_frequencies(grain);
    for (std::size_t k = 0; k < m.size; ++k)
      EXPECT_NEAR(omega[k] * omega[k], values[static_cast<Eigen::Index>(k)], 1e-13 * omega.back() * omega.back());
  }
}

// K = G^T k G + geometric term, which is that of the chord r alone: N and T of a beam with d^2 L = t t^T/L and
// d^2(angle of r) = -(n t^T + t n^T)/L^2.
MatrixXd tangent(const GrainTemplate& grain, const Coordinates& x) {
  const auto n = static_cast<Eigen::Index>(x.size());
  MatrixXd k = MatrixXd::Zero(n, n);
  for (const GrainBeam& b : grain.beams) {
    const BeamShape s = shape_of(b, x);
    const BeamForce f = beam_force(b.beam, s.frame.distance, s.turn_i, s.turn_j);
    const BeamStiffness stiff = beam_stiffness(b.beam, s.frame.distance);
    const Eigen::Vector2d normal(s.frame.nx, s.frame.ny), tangential(-s.frame.ny, s.frame.nx);
    const double length = s.frame.distance;
    for (const auto& [row, value] : {std::pair{0, stiff.normal}, {1, stiff.tangential}, {2, stiff.rolling}}) {
      Coordinates g(x.size(), 0.0);
      add_load(b, link_load(s.frame, row == 0 ? 1.0 : 0.0, row == 1 ? 1.0 : 0.0, row == 2 ? 1.0 : 0.0), g);
      const auto v = Eigen::Map<const VectorXd>(g.data(), n);
      k += value * v * v.transpose();
    }
    const Eigen::Matrix2d geometric =
        -f.normal / length * tangential * tangential.transpose() +
        f.tangential / length * (normal * tangential.transpose() + tangential * normal.transpose());
    const Eigen::Index i = 3 * b.i, j = 3 * b.j;
    k.block<2, 2>(i, i) += geometric, k.block<2, 2>(j, j) += geometric;
    k.block<2, 2>(i, j) -= geometric, k.block<2, 2>(j, i) -= geometric;
  }
  return k;
}

TEST(GrainSpectrum, StiffnessIsTheSecondDerivativeOfTheEnergy) {
  for (const char* shape : {"square", "polygon5", "rod", "L", "star"})
    for (const double deformation : {0.0, 0.05}) {  // [of the radius; rad]
      const GrainTemplate grain = grain_of(shape);
      const Coordinates x = sum(as_built(grain), random_motion(grain, deformation, 3));
      const MatrixXd expected = tangent(grain, x);
      const auto n = static_cast<Eigen::Index>(x.size());
      if (deformation == 0) {
        EXPECT_LT((expected - matrix(grain_matrices(grain).stiffness)).norm(), 1e-12 * expected.norm());
      }
      MatrixXd differences(n, n);
      for (Eigen::Index c = 0; c < n; ++c) {  // fourth order
        const double h = 1e-4 * (c % 3 == 2 ? 1 : grain.beams[0].beam.rest_length);
        const auto force = [&](double by) {
          Coordinates y = x;
          y[idx(c)] += by;
          const Coordinates f = elastic_forces(grain, y);
          return VectorXd(Eigen::Map<const VectorXd>(f.data(), n));
        };
        differences.col(c) = -(8 * (force(h) - force(-h)) - (force(2 * h) - force(-2 * h))) / (12 * h);
        const auto potential = [&](double by) {
          Coordinates y = x;
          y[idx(c)] += by;
          return energy(grain, y);
        };
        const double slope = (8 * (potential(h) - potential(-h)) - (potential(2 * h) - potential(-2 * h))) / (12 * h);
        EXPECT_NEAR(-elastic_forces(grain, x)[idx(c)], slope, 1e-8 * h * std::abs(expected(c, c)) + 1e-6);
      }
      EXPECT_LT((differences - expected).norm(), 1e-9 * expected.norm()) << shape << ' ' << deformation;
    }
}

// Appendix A: a shear D of a beam whose ends do not turn, F = 12 EI D/L^3 and M_A = M_B = 6 EI D/L^2 (Eqs. 32-33), is
// to first order the bending T_a = T_b = -D/L of the same beam (Eqs. 47-49).
TEST(Beam, ShearIsBendingByMinusTheChordsTurn) {
  const double length = 0.047, bending = 10;
  const Beam beam{length, 0, 0, 1e5, bending};
  double previous = 0;
  for (const double shear : {1e-3 * length, 1e-4 * length, 1e-5 * length}) {
    const Vec2 chord{{length, shear}};
    const double turn = end_rotation({{1, 0}}, chord);  // of both ends: neither has turned
    EXPECT_NEAR(turn, -shear / length, 1e-6 * shear / length);
    const BeamForce f = beam_force(beam, norm(chord), turn, turn);
    const LinkLoad<double> load =
        link_load(link_frame(chord[0], chord[1], length / 2, length / 2), f.normal, f.tangential, f.moment);
    const double force = 12 * bending * shear / (length * length * length), moment = force * length / 2;
    EXPECT_NEAR(load.fy / -force, 1,
                2 * (shear / length) * (shear / length) + 1e-9);  // restoring, on the end that was moved up
    EXPECT_NEAR(load.moment_i / moment, 1, 2 * (shear / length) * (shear / length) + 1e-9);
    EXPECT_NEAR(load.moment_j / moment, 1, 2 * (shear / length) * (shear / length) + 1e-9);
    const double error = std::abs(load.fx) / force;  // of first order in the shear: 0 in linear approximation
    if (previous > 0) {
      EXPECT_NEAR(error / previous, 0.1, 1e-3);
    }
    previous = error;
  }
}

// Eqs. 50-53 as they stand for the moments and the force along the chord; across it F_B = -F_A = -(M_A + M_B)/L.
TEST(BeamDamping, IsThePapersPlusTheBalancingForce) {
  const Beam beam{0.05, 0.1, -0.2, 1e5, 10};
  const double gamma = 9, moment = 1e-4, length = 0.06;
  const LinkFrame<double> frame = link_frame(0.048, 0.036, 0.025, 0.025);
  const double dvx = 0.7, dvy = -0.3, spin_i = 11, spin_j = -4;
  const double across = -frame.ny * dvx + frame.nx * dvy, chord_turns = across / length;
  const BeamDamping c = beam_damping(beam, gamma, length);
  const LinkVelocity<double> v = link_velocity(frame, dvx, dvy, spin_i, spin_j);
  const LinkLoad<double> load =
      link_load(frame, -c.normal * v.normal, -c.tangential * v.tangential, -c.rolling * v.rolling);
  const double moment_a = -gamma * moment / beam.rest_length * (spin_i - chord_turns);
  const double moment_b = -gamma * moment / beam.rest_length * (spin_j - chord_turns);
  EXPECT_NEAR(load.moment_i, moment_a, 1e-14);
  EXPECT_NEAR(load.moment_j, moment_b, 1e-14);
  EXPECT_NEAR(frame.nx * load.fx + frame.ny * load.fy, -gamma * (frame.nx * dvx + frame.ny * dvy), 1e-13);
  EXPECT_NEAR(-frame.ny * load.fx + frame.nx * load.fy, -(moment_a + moment_b) / length, 1e-13);
}

TEST(BeamDamping, BalancesAndOnlyTakesEnergy) {
  for (const char* shape : {"square", "rod", "L", "star"})
    for (std::uint64_t seed = 1; seed < 10; ++seed) {
      const GrainTemplate grain = grain_of(shape);
      const Coordinates x = sum(as_built(grain), random_motion(grain, 0.1, seed));
      const Coordinates v = random_motion(grain, 100, 10 * seed);
      const Coordinates f = damper_forces(grain, x, v);
      double largest = 0, power = 0;
      for (std::size_t d = 0; d < f.size(); ++d) {
        largest = std::max(largest, std::abs(f[d]) * (d % 3 == 2 ? 1 / grain.radius : 1));
        power += f[d] * v[d];
      }
      const auto [fx, fy, torque] = resultant(x, f);
      EXPECT_NEAR(fx, 0, 1e-13 * largest);
      EXPECT_NEAR(fy, 0, 1e-13 * largest);
      EXPECT_NEAR(torque, 0, 1e-13 * largest * grain.radius);
      EXPECT_LT(power, 0);
      Coordinates rigid(x.size());  // a rigid motion meets no damper
      for (std::size_t t = 0; t < x.size(); t += 3)
        rigid[t] = 3 - 50 * x[t + 1], rigid[t + 1] = -7 + 50 * x[t], rigid[t + 2] = 50;
      for (const double each : damper_forces(grain, x, rigid)) EXPECT_NEAR(each, 0, 1e-12 * largest);
    }
}

TEST(BeamDamping, MatrixIsSymmetricAndHasTheRigidMotionsAsItsKernel) {
  for (const char* shape : {"square", "rod", "L", "star"}) {
    const GrainTemplate grain = grain_of(shape);
    const GrainMatrices m = grain_matrices(grain);
    const MatrixXd damping = matrix(m.damping);
    EXPECT_EQ(damping, damping.transpose());
    const VectorXd scale = Eigen::Map<const VectorXd>(m.mass.data(), damping.rows()).cwiseSqrt().cwiseInverse();
    const VectorXd values =
        Eigen::SelfAdjointEigenSolver<MatrixXd>(scale.asDiagonal() * damping * scale.asDiagonal()).eigenvalues();
    for (Eigen::Index k = 0; k < 3; ++k) EXPECT_NEAR(values[k], 0, 1e-13 * values.tail(1)[0]);
    EXPECT_GT(values[3], 1e-8 * values.tail(1)[0]);
    // the matrix of the spectrum and the dampers in motion are the same thing
    const Coordinates v = random_motion(grain, 1, 5), f = damper_forces(grain, as_built(grain), v);
    const auto n = damping.rows();
    EXPECT_LT((damping * Eigen::Map<const VectorXd>(v.data(), n) + Eigen::Map<const VectorXd>(f.data(), n)).norm(),
              1e-13 * Eigen::Map<const VectorXd>(f.data(), n).norm());
  }
}

}  // namespace
}  // namespace isostat
