// Stiffness and modes of grains of triangles: against finite differences of the forces at rest, the frequencies of one
// grain, and the solver's stress.
#include <gtest/gtest.h>
#include <Eigen/Dense>

#include <random>

#include "analysis/rigidity/exact_rank.hpp"
#include "analysis/rigidity/rigidity_matrix.hpp"
#include "analysis/stiffness/area_tangent.hpp"
#include "analysis/stiffness/bases.hpp"
#include "analysis/stiffness/link_tangent.hpp"
#include "analysis/stiffness/moduli.hpp"
#include "analysis/stiffness/prestressed_modes.hpp"
#include "analysis/stiffness/stiffness_matrix.hpp"
#include "analysis/stiffness/vibration.hpp"
#include "dem/files/packing_file.hpp"
#include "dem/triangles/at_rest.hpp"
#include "dem/triangles/certificate.hpp"
#include "dem/triangles/grain_shape.hpp"
#include "dem/triangles/grain_spectrum.hpp"
#include "dem/triangles/network_file.hpp"
#include "dem/triangles/overlap_search.hpp"
#include "dem/triangles/touching_triangles.hpp"

namespace isostat {
namespace {

std::string text_of(const GrainTemplate& grain, int number, const Vec2& at, double angle) {
  std::string text;
  char line[400];
  const int first = 100 * number;
  const auto turned = [&](const Vec2& r) {
    return at +
           Vec2{{std::cos(angle) * r[0] - std::sin(angle) * r[1], std::sin(angle) * r[0] + std::cos(angle) * r[1]}};
  };
  for (std::size_t k = 0; k < grain.triangles.size(); ++k) {
    std::array<Vec2, 3> c;
    for (std::size_t n = 0; n < 3; ++n) c[n] = turned(grain.triangles[k].centroid + grain.triangles[k].corner[n]);
    std::snprintf(line, sizeof line, "triangle %d %d %.17g %.17g %.17g %.17g %.17g %.17g\n",
                  first + static_cast<int>(k), number, c[0][0], c[0][1], c[1][0], c[1][1], c[2][0], c[2][1]);
    text += line;
  }
  for (const GrainBeam& b : grain.beams)
    text += "beam " + std::to_string(first + b.i) + " " + std::to_string(first + b.j) + "\n";
  return text;
}

AnalysisInput input_of(const State<TriangleGrains>& state) {
  AnalysisInput input;
  input.set_triangles(state, placed_triangles(state.packing));
  return input;
}

// Loose and loaded: every triangle is moved a little, so that beams and overlaps have forces.
State<TriangleGrains> shaken(const std::string& text, double by, unsigned seed) {
  State<TriangleGrains> s = foreign_state(parse_triangle_network(text, "t.net").packing);
  std::mt19937 random(seed);
  const auto unit = [&] { return std::uniform_real_distribution<>(-1, 1)(random); };
  for (std::size_t k = 0; k < s.packing.bodies.size(); ++k) {
    s.packing.bodies.position[k] += Vec2{{by * unit(), by * unit()}};
    s.packing.angle[k] += 3 * by * unit();
  }
  for (Link<2>& l : s.packing.links) set_beam_force(s.packing, l);
  s.packing.overlaps = overlaps_of(s.packing, s.law, overlapping_triangles(s.packing));  // as a run keeps them
  return s;
}

std::string several(bool periodic) {
  const GrainTemplate square = grain_template(grain_shape("square", 1.0), {}),
                      rod = grain_template(grain_shape("rod", 2.0), {}),
                      ell = grain_template(grain_shape("L", 1.5), {});
  return std::string(periodic ? "cell 2.1 2.3\n" : "") + text_of(square, 1, {{0, 0}}, 0.1) +
         text_of(square, 2, {{0.93, 0.2}}, 0.03) + text_of(rod, 3, {{0.5, 0.85}}, 0.2) +
         text_of(ell, 4, {{1.2, 1.5}}, 1.1);
}

// Forces and moments on every triangle as one vector, as the certificate judges them.
Eigen::VectorXd forces(const State<TriangleGrains>& s) {
  const auto loads = net_loads(s.packing, s.law, 0);
  Eigen::VectorXd f(static_cast<Eigen::Index>(3 * loads.size()));
  for (std::size_t k = 0; k < loads.size(); ++k)
    f.segment<3>(static_cast<Eigen::Index>(3 * k)) << loads[k].fx, loads[k].fy, loads[k].moment;
  return f;
}
State<TriangleGrains> moved(State<TriangleGrains> s, Eigen::Index dof, double by) {
  const auto k = static_cast<std::size_t>(dof / 3);
  if (dof % 3 == 2)
    s.packing.angle[k] += by;
  else
    s.packing.bodies.position[k][static_cast<int>(dof % 3)] += by;
  return s;
}

Eigen::MatrixXd dense(const UnsymmetricMatrix& a) {
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(a.size, a.size);
  for (Eigen::Index c = 0; c < a.size; ++c)
    for (auto e = static_cast<std::size_t>(a.start[static_cast<std::size_t>(c)]);
         e < static_cast<std::size_t>(a.start[static_cast<std::size_t>(c) + 1]); ++e)
      m(a.row[e], c) = a.value[e];
  return m;
}

TEST(TriangleStiffness, ForcesOfLinksAreGTransposed) {
  for (const bool periodic : {false, true}) {
    const State<TriangleGrains> s = shaken(several(periodic), 0.01, 3);
    const AnalysisInput input = input_of(s);
    ASSERT_GT(input.triangle_links.areas.size(), 2u);
    const RigidityMatrix g = rigidity_matrix(input.network(), NetworkLaw::frictionless, false);
    const std::vector<double> f = g.body_forces(link_forces(input.network(), g));
    const Eigen::VectorXd expected = forces(s);
    EXPECT_LT((Eigen::Map<const Eigen::VectorXd>(f.data(), expected.size()) - expected).lpNorm<Eigen::Infinity>(),
              1e-10 * expected.lpNorm<Eigen::Infinity>());
  }
}

TEST(TriangleStiffness, StressOfAFreeCellIsItsColumns) {
  const State<TriangleGrains> s = shaken(several(true), 0.01, 4);
  const AnalysisInput input = input_of(s);
  const RigidityMatrix g = rigidity_matrix(input.network(), NetworkLaw::frictionless, true);
  const std::vector<double> f = g.body_forces(link_forces(input.network(), g));
  const StressTensor stress = measured_stress(s);
  const double area = s.packing.cell->measure();
  EXPECT_NEAR(-f[f.size() - 2] / area, stress.xx, 1e-9 * std::abs(stress.xx));
  EXPECT_NEAR(-f[f.size() - 1] / area, stress.yy, 1e-9 * std::abs(stress.xx));
}

TEST(TriangleStiffness, FrictionActsAsInTheSolver) {
  State<TriangleGrains> s = shaken(several(true), 0.01, 5);
  s.law.friction = 0.5, s.law.tangential_stiffness = 1e5;
  AnalysisInput input = input_of(s);
  s.packing.overlaps.clear();
  double tension = 100;
  for (AreaLink& a : input.triangle_links.areas) {
    Overlap o;
    o.grain_i = a.grain_i, o.grain_j = a.grain_j, o.shift = a.shift, o.tangential_force = tension *= -1.5;
    s.packing.overlaps.push_back(o);
  }
  input = input_of(s);
  const RigidityMatrix g = rigidity_matrix(input.network(), NetworkLaw::friction, false);
  const std::vector<double> f = g.body_forces(link_forces(input.network(), g));
  const Eigen::VectorXd expected = forces(s);
  EXPECT_LT((Eigen::Map<const Eigen::VectorXd>(f.data(), expected.size()) - expected).lpNorm<Eigen::Infinity>(),
            1e-10 * expected.lpNorm<Eigen::Infinity>());
}

TEST(TriangleStiffness, TangentIsTheDerivativeOfTheForces) {
  for (const bool periodic : {false, true}) {
    const State<TriangleGrains> s = shaken(several(periodic), 0.01, 7);
    const AnalysisInput input = input_of(s);
    const Eigen::MatrixXd k =
        dense(tangent_stiffness(input.network(), NetworkLaw::frictionless, default_network_law()));
    EXPECT_LT((k - k.transpose()).norm(), 1e-12 * k.norm());  // all forces have an energy
    constexpr double kStep = 1e-7;
    for (Eigen::Index d = 0; d < k.cols(); ++d) {
      const Eigen::VectorXd column = (forces(moved(s, d, -kStep)) - forces(moved(s, d, kStep))) / (2 * kStep);
      EXPECT_LT((column - k.col(d)).norm(), 1e-6 * k.col(d).norm()) << "dof " << d;
    }
  }
}

TEST(TriangleStiffness, ModesOfOneGrainAreItsFrequencies) {
  for (const char* name : {"square", "rod", "L", "star", "polygon6"}) {
    const GrainTemplate grain = grain_template(grain_shape(name), {});
    const AnalysisInput input =
        input_of(foreign_state(parse_triangle_network(text_of(grain, 0, {{0.3, -0.2}}, 0.4), "t.net").packing));
    const VibrationModes modes =
        vibration_modes(input.network(), NetworkLaw::frictionless, default_network_law(), 1000, false);
    const std::vector<double> expected = grain_frequencies(grain);
    ASSERT_EQ(modes.zero_modes, 3) << name;
    ASSERT_EQ(modes.omega.size() + 3, expected.size()) << name;
    for (std::size_t m = 0; m < modes.omega.size(); ++m)
      EXPECT_NEAR(modes.omega[m], expected[m + 3], 1e-9 * expected.back()) << name;
  }
}

TEST(TriangleStiffness, PrestressedModesAreEigenvaluesOfTheTangent) {
  const State<TriangleGrains> s = shaken(several(true), 0.005, 9);
  const AnalysisInput input = input_of(s);
  const LinkNetwork n = input.network();
  Eigen::MatrixXd k = dense(tangent_stiffness(n, NetworkLaw::frictionless, default_network_law()));
  const std::vector<double> mass = dof_masses(n, NetworkLaw::frictionless);
  for (Eigen::Index r = 0; r < k.rows(); ++r)
    for (Eigen::Index c = 0; c < k.cols(); ++c)
      k(r, c) /= std::sqrt(mass[static_cast<std::size_t>(r)] * mass[static_cast<std::size_t>(c)]);
  std::vector<double> expected;
  const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k).eigenvalues();
  for (Eigen::Index m = 0; m < values.size(); ++m) expected.push_back(values[m]);
  std::sort(expected.begin(), expected.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
  const PrestressedModes modes = prestressed_modes(n, NetworkLaw::frictionless, default_network_law(), 6);
  ASSERT_GE(modes.omega_squared.size(), 6u);
  for (std::size_t m = 0; m < 6; ++m)
    EXPECT_NEAR(modes.omega_squared[m].real(), expected[m + 2], 1e-8 * expected.back());
}

TEST(TriangleStiffness, ModuliAreThoseOfTheSolver) {
  // Relaxed response by finite differences of the solver's forces and stress; without prestress of beams, small area.
  const State<TriangleGrains> s = shaken(several(true), 0.01, 11);
  const AnalysisInput input = input_of(s);
  const auto n = static_cast<Eigen::Index>(3 * s.packing.bodies.size());
  const auto strained = [&](int axis, double e) {
    State<TriangleGrains> t = s;
    t.packing.cell->length[axis] *= 1 - e;
    for (Vec2& r : t.packing.bodies.position) r[axis] *= 1 - e;
    return t;
  };
  const auto stress = [](const State<TriangleGrains>& t) {
    const StressTensor m = measured_stress(t);
    return Eigen::Vector3d(m.xx, m.yy, 0.5 * (m.xy + m.yx));
  };
  constexpr double kStep = 1e-7;
  Eigen::MatrixXd jacobian(n, n), stress_of(3, n);
  for (Eigen::Index d = 0; d < n; ++d) {
    jacobian.col(d) = (forces(moved(s, d, kStep)) - forces(moved(s, d, -kStep))) / (2 * kStep);
    stress_of.col(d) = (stress(moved(s, d, kStep)) - stress(moved(s, d, -kStep))) / (2 * kStep);
  }
  const TangentModuli moduli = tangent_moduli(input.network(), NetworkLaw::frictionless, default_network_law());
  for (int axis = 0; axis < 2; ++axis) {
    const Eigen::VectorXd load = (forces(strained(axis, kStep)) - forces(strained(axis, -kStep))) / (2 * kStep);
    const Eigen::VectorXd u = jacobian.bottomRightCorner(n - 2, n - 2).fullPivLu().solve(-load.tail(n - 2));
    const Eigen::Vector3d response =
        (stress(strained(axis, kStep)) - stress(strained(axis, -kStep))) / (2 * kStep) + stress_of.rightCols(n - 2) * u;
    for (int a = 0; a < 3; ++a)
      EXPECT_NEAR(moduli.tensor[static_cast<std::size_t>(a)][static_cast<std::size_t>(axis)], response[a],
                  1e-4 * response.norm());
  }
}

TEST(TriangleStiffness, PlainModuliByDenseAlgebra) {
  State<TriangleGrains> s = shaken(several(true), 0, 1);
  s.law.friction = 0.5, s.law.tangential_stiffness = 1e5;
  const AnalysisInput input = input_of(s);
  const LinkNetwork n = input.network();
  const RigidityMatrix g = rigidity_matrix(n, NetworkLaw::friction, true);
  const std::vector<double> k = row_stiffness(n, g, default_network_law());
  Eigen::MatrixXd m =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(g.rows()), static_cast<Eigen::Index>(g.columns()));
  for (Eigen::Index r = 0; r < m.rows(); ++r)
    for (auto e = g.row_start[static_cast<std::size_t>(r)]; e < g.row_start[static_cast<std::size_t>(r) + 1]; ++e)
      m(r, g.column[static_cast<std::size_t>(e)]) =
          std::sqrt(k[static_cast<std::size_t>(r)]) * g.value[static_cast<std::size_t>(e)];
  const Eigen::MatrixXd bodies = m.leftCols(m.cols() - 2), strains = m.rightCols(2);
  const Eigen::MatrixXd rest = strains - bodies * bodies.completeOrthogonalDecomposition().solve(strains);
  const Eigen::MatrixXd expected = rest.transpose() * rest / n.packing.cell->measure();
  const Moduli moduli = elastic_moduli(n, NetworkLaw::friction, default_network_law());
  for (std::size_t a = 0; a < 2; ++a)
    for (std::size_t b = 0; b < 2; ++b)
      EXPECT_NEAR(moduli[a][b], expected(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b)),
                  1e-8 * expected.norm());
}

TEST(TriangleStiffness, BasesAreNullVectors) {
  const AnalysisInput input = input_of(shaken(several(true), 0, 1));
  const ExactRank r = exact_rank(input.network(), NetworkLaw::frictionless, true);
  const auto modes = floppy_modes(input.network(), NetworkLaw::frictionless, true, 100);
  EXPECT_EQ(static_cast<std::int64_t>(modes.size()), r.floppy);
  for (const NullVector& v : modes) EXPECT_LT(v.residual, 1e-8);
  const auto states = self_stress_states(input.network(), NetworkLaw::frictionless, true, 100);
  EXPECT_EQ(static_cast<std::int64_t>(states.size()), r.hyperstatic);
  for (const NullVector& v : states) EXPECT_LT(v.residual, 1e-8);
}

}  // namespace
}  // namespace isostat
