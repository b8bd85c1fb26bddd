// Exact rank, clusters and counts of grains of triangles: the square of the paper, walls, and rational elimination.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>

#include "analysis/report.hpp"
#include "analysis/rigidity/clusters.hpp"
#include "analysis/rigidity/exact_rank.hpp"
#include "analysis/rigidity/independent_columns.hpp"
#include "dem/files/packing_file.hpp"
#include "dem/input_error.hpp"
#include "dem/triangles/network_file.hpp"
#include "tests/oracle/rational_rank.hpp"

namespace isostat {
namespace {

constexpr NetworkLaw kLaws[] = {NetworkLaw::frictionless, NetworkLaw::friction};

// A square of four triangles about (x, y) turned by `angle`, its beams in a ring; ids from 4 grain on.
std::string square(int grain, double x, double y, double side = 1, double angle = 0) {
  std::string text;
  char line[400];
  const auto corner = [&](int k, double& cx, double& cy) {
    const double a = angle + (k + 0.5) * 1.5707963267948966, r = side / std::sqrt(2.0);
    cx = x + r * std::cos(a), cy = y + r * std::sin(a);
  };
  for (int k = 0; k < 4; ++k) {
    double ax, ay, bx, by;
    corner(k, ax, ay), corner(k + 1, bx, by);
    std::snprintf(line, sizeof line, "triangle %d %d %.17g %.17g %.17g %.17g %.17g %.17g\n", 4 * grain + k, grain, x, y,
                  ax, ay, bx, by);
    text += line;
  }
  for (int k = 0; k < 4; ++k)
    text += "beam " + std::to_string(4 * grain + k) + " " + std::to_string(4 * grain + (k + 1) % 4) + "\n";
  return text;
}

AnalysisInput input_of(TriangleNetworkFile file) {
  AnalysisInput input;
  input.path = "t.net";
  const std::vector<Triangle> corners = file.triangles;
  input.set_triangles(foreign_state(std::move(file.packing)), corners);
  return input;
}
AnalysisInput input_of(const std::string& text) { return input_of(parse_triangle_network(text, "t.net")); }

TEST(TriangleRank, ASquare) {
  const AnalysisInput input = input_of(square(0, 0.1, 0.2));
  const ExactRank r = exact_rank(input.network(), NetworkLaw::frictionless, false);
  EXPECT_EQ(r.dofs, 12);
  EXPECT_EQ(r.rows, 12);
  EXPECT_EQ(r.rank, 9);
  EXPECT_EQ(r.hyperstatic, 3);
  EXPECT_EQ(r.floppy, 3);
  EXPECT_EQ(r.trivial, 3);
  EXPECT_EQ(r.rattler_modes, 0);
  EXPECT_EQ(r.mechanisms, 0);
  EXPECT_TRUE(r.bounds_meet);
}

TEST(TriangleRank, TwoSquaresAndALooseOne) {
  const AnalysisInput input = input_of(square(0, 0, 0) + square(1, 0.9, 0.3) + square(2, 5, 5));
  for (const NetworkLaw law : kLaws) {
    const bool friction = law == NetworkLaw::friction;
    const ExactRank r = exact_rank(input.network(), law, false);
    EXPECT_EQ(r.dofs, 36);
    EXPECT_EQ(r.rows, 36 + (friction ? 2 : 1));
    EXPECT_EQ(r.hyperstatic, 9);
    EXPECT_EQ(r.floppy, 9 - (friction ? 2 : 1));
    EXPECT_EQ(r.rattler_modes, 3);
    EXPECT_EQ(r.mechanisms, friction ? 1 : 2);
  }
}

TEST(TriangleRank, WhatIsHeldHasNoColumns) {
  TriangleNetworkFile file = parse_triangle_network(
      "triangle 90 9 -3 -1 3 -1 3 0\ntriangle 91 9 -3 -1 3 0 -3 0\nbeam 90 91\n" + square(0, 0, 0.48), "t.net");
  file.packing.grains.part[0] = GrainPart::wall;  // first in the order of the state
  const AnalysisInput input = input_of(std::move(file));
  EXPECT_EQ(input.network().free, 4);
  EXPECT_EQ(input.packing().bodies.id[0], 0);  // the square comes first
  const ExactRank r = exact_rank(input.network(), NetworkLaw::frictionless, false);
  EXPECT_EQ(r.dofs, 12);
  EXPECT_EQ(r.rows, 13);  // a beam inside the wall is none
  EXPECT_EQ(r.rank, 10);
  EXPECT_EQ(r.trivial, 0);
  EXPECT_EQ(r.mechanisms, 2);
  EXPECT_EQ(exact_rank(input.network(), NetworkLaw::friction, false).mechanisms, 1);
  // A beam to the wall holds all of it.
  TriangleNetworkFile held =
      parse_triangle_network("triangle 90 9 -3 -1 3 -1 3 0\n" + square(0, 0, 0.48) + "beam 90 0\n", "t.net");
  held.packing.grains.part[0] = GrainPart::wall;
  const ExactRank h = exact_rank(input_of(std::move(held)).network(), NetworkLaw::frictionless, false);
  EXPECT_EQ(h.rank, 12);
  EXPECT_EQ(h.floppy, 0);
}

// Random convex grains, quadrilaterals of two triangles or single ones, some beams, isolated and in a cell.
std::string random_grains(int trial) {
  std::mt19937_64 random(static_cast<std::uint64_t>(trial) + 3);
  const auto uniform = [&](double a, double b) { return std::uniform_real_distribution<>(a, b)(random); };
  const auto dyadic = [](double v) { return std::ldexp(std::round(std::ldexp(v, 12)), -12); };  // images are then exact
  const bool periodic = trial % 2 == 1;
  const int grains = 3 + trial % 5;
  std::string text = periodic ? "cell 2.25 2.125\n" : "", beams;
  char line[400];
  for (int g = 0; g < grains; ++g) {
    const double x = uniform(0, 2), y = uniform(0, 2), turn = uniform(0, 6.28);
    double cx[4], cy[4];
    for (int k = 0; k < 4; ++k) {
      const double a = turn + k * 1.5707963267948966 + uniform(-0.3, 0.3), r = uniform(0.5, 0.7);
      cx[k] = dyadic(x + r * std::cos(a)), cy[k] = dyadic(y + r * std::sin(a));
    }
    for (int half = 0; half < (g % 3 == 2 ? 1 : 2); ++half) {
      std::snprintf(line, sizeof line, "triangle %d %d %.17g %.17g %.17g %.17g %.17g %.17g\n", 2 * g + half, g, cx[0],
                    cy[0], cx[1 + half], cy[1 + half], cx[2 + half], cy[2 + half]);
      text += line;
    }
    if (g % 3 != 2 && uniform(0, 1) < 0.8)
      beams += "beam " + std::to_string(2 * g) + " " + std::to_string(2 * g + 1) + "\n";
    if (g > 0 && uniform(0, 1) < 0.3) beams += "beam " + std::to_string(2 * g) + " " + std::to_string(2 * g - 2) + "\n";
  }
  return text + beams;
}

TEST(TriangleRank, EqualsRationalElimination) {
  int links = 0;
  for (int trial = 0; trial < 16; ++trial) {
    const TriangleNetworkFile file = parse_triangle_network(random_grains(trial), "t.net");
    const TrianglePacking packing = file.packing;
    const std::vector<Triangle> triangles = file.triangles;
    const AnalysisInput input = input_of(file);
    links += static_cast<int>(input.triangle_links.areas.size());
    for (const NetworkLaw law : kLaws)
      for (const bool cell_free : {false, true}) {
        if (cell_free && !packing.cell) continue;
        const ExactRank r = exact_rank(input.network(), law, cell_free);
        EXPECT_EQ(r.rank, rational_rank(packing, triangles, law, cell_free)) << "trial " << trial;
        EXPECT_TRUE(r.certified);
        const auto dependent = dependent_columns(input.network(), law, cell_free);
        EXPECT_EQ(std::count(dependent.begin(), dependent.end(), 1), r.floppy);
      }
  }
  EXPECT_GT(links, 80);
}

// On a lattice of aligned squares, corners lie on edges and edges on edges.
TEST(TriangleRank, AlignedSquaresOnALattice) {
  std::string text = "cell 2 2\n";
  for (int g = 0; g < 4; ++g) {
    const double x = g % 2, y = static_cast<double>(g / 2);
    const double cx[] = {x - 0.625, x + 0.625, x + 0.625, x - 0.625},
                 cy[] = {y - 0.625, y - 0.625, y + 0.625, y + 0.625};
    for (std::size_t k = 0; k < 4; ++k) {
      text += "triangle " + std::to_string(4 * g + static_cast<int>(k)) + " " + std::to_string(g);
      for (const double v : {x, y, cx[k], cy[k], cx[(k + 1) % 4], cy[(k + 1) % 4]}) text += " " + std::to_string(v);
      text += "\n";
    }
    for (int k = 0; k < 4; ++k)
      text += "beam " + std::to_string(4 * g + k) + " " + std::to_string(4 * g + (k + 1) % 4) + "\n";
  }
  const TriangleNetworkFile file = parse_triangle_network(text, "t.net");
  const AnalysisInput input = input_of(file);
  for (const bool cell_free : {false, true}) {
    const ExactRank r = exact_rank(input.network(), NetworkLaw::frictionless, cell_free);
    EXPECT_TRUE(r.certified);
    EXPECT_FALSE(r.bounds_meet);  // rows of equal overlaps depend on each other here, not in general
    EXPECT_EQ(r.rank, rational_rank(file.packing, file.triangles, NetworkLaw::frictionless, cell_free));
  }
}

TEST(TriangleRank, Clusters) {
  // Two squares that a beam joins, a third that lies on them, a fourth alone.
  const AnalysisInput input =
      input_of(square(0, 0, 0) + square(1, 3, 0) + "beam 0 4\n" + square(2, 0.9, 0.2) + square(3, 9, 9));
  const RigidClusters found = rigid_clusters(input.network(), NetworkLaw::frictionless, false);
  ASSERT_EQ(found.clusters.size(), 1u);
  EXPECT_EQ(found.clusters[0].grains, 2);
  EXPECT_EQ(found.clusters[0].links, 9);
  EXPECT_EQ(found.clusters[0].hyperstatic, 6);
  EXPECT_EQ(found.cluster_of_grain[0], 0);
  EXPECT_EQ(found.cluster_of_grain[8], -1);
  EXPECT_EQ(found.cluster_of_link.back(), -1);  // the overlap
  // A bar on two squares that a beam joins: with friction it cannot move against them.
  const std::string bridge = square(0, 0, 0) + square(1, 3, 0) + "beam 0 4\ntriangle 90 2 -1 .45 4 .48 1.5 2\n";
  EXPECT_EQ(rigid_clusters(input_of(bridge).network(), NetworkLaw::frictionless, false).clusters[0].grains, 2);
  EXPECT_EQ(rigid_clusters(input_of(bridge).network(), NetworkLaw::friction, false).clusters[0].grains, 3);
}

TEST(TriangleRank, SectionsAndRefusals) {
  const AnalysisInput input = input_of("cell 3 3\n" + square(0, 0, 0) + square(1, 0.9, 0.3) + square(2, 1.5, 1.9));
  const auto report = analyze(input, {}, {});
  EXPECT_EQ(report["units"]["length"], "cm");
  EXPECT_EQ(report["counts"]["grains"], 3);
  EXPECT_EQ(report["counts"]["triangles"], 12);
  EXPECT_EQ(report["counts"]["contacts"], 1);
  EXPECT_EQ(report["counts"]["rattlers"], 1);
  EXPECT_NEAR(report["counts"]["z"].get<double>(), 2.0 / 3, 1e-15);
  EXPECT_NEAR(report["counts"]["solid_fraction"].get<double>(), 1.0 / 3, 1e-15);
  for (const char* name : {"equilibrium", "stress", "rigidity", "clusters", "stiffness", "moduli"})
    EXPECT_TRUE(report.contains(name)) << name;
  for (const char* name : {"forces", "percolation", "pores", "scattering", "dacf"}) {
    EXPECT_FALSE(report.contains(name)) << name;
    EXPECT_THROW(analyze(input, {}, {name}), InputError) << name;
  }
  AnalysisOptions rolling;
  rolling.law = NetworkLaw::rolling;
  EXPECT_THROW(analyze(input, rolling, {"rigidity"}), InputError);
  AnalysisInput paper = input;
  paper.triangles->law.contact = ContactLaw::paper;
  EXPECT_THROW(analyze(paper, {}, {"rigidity"}), InputError);
  EXPECT_NO_THROW(analyze(paper, {}, {"counts"}));
}

}  // namespace
}  // namespace isostat
